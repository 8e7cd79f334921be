// The cameras of the three robots: the footbot's omnidirectional and forward cameras, the eyebot's downward one and the
// one that turns with its laser, and the handbot's forward one. Each has an ideal model (with noise on distance and
// angle) and one with noise in pixels.
#include <algorithm>

#include "common/control_interface/eyebot/ci_eyebot_camera_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_pan_tilt_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_perspective_camera_sensor.h"
#include "common/control_interface/handbot/ci_handbot_camera_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/cameras/colour_camera.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

// The differences between the robots.
struct FootbotCamera
{
  using Interface = CCI_FootBotOmnidirectionalCameraSensor;
  static constexpr const char* kLabel = "footbot_omnidirectional_camera";
  static constexpr bool kHasHeight = true;
  static CameraModel Model() { return {CameraModel::View::kDown, {0, 0, 0.2887}, 0, 0}; }
};
// It sees as in ARGoS3 (colored_blob_omnidirectional_camera, rot_z_only).
struct Argos3FootbotCamera : FootbotCamera
{
  static CameraModel Model() { return {CameraModel::View::kDown, {0, 0, 0.2887}, 0, 0, true}; }
};
struct FootbotPerspectiveCamera
{
  using Interface = CCI_FootBotPerspectiveCameraSensor;
  static constexpr const char* kLabel = "footbot_perspective_camera";
  static constexpr bool kHasPosition = true;
  // The camera is in the rim, as high as the beacon (ARGoS3, foot-bot).
  static CameraModel Model() { return {CameraModel::View::kAhead, {0.085036758, 0, 0.174}, 0, 0}; }
};
struct EyebotCamera
{
  using Interface = CCI_EyeBotCameraSensor;
  static constexpr const char* kLabel = "eyebot_camera";
  static CameraModel Model() { return {CameraModel::View::kDown, {0, 0, 0}, 0, 0}; }
};
struct EyebotPanTiltCamera
{
  using Interface = CCI_EyeBotPanTiltCameraSensor;
  static constexpr const char* kLabel = "eyebot_pan_tilt_camera";
  static CameraModel Model() { return {CameraModel::View::kTurned, {0, 0, 0}, 0, 0}; }
};
struct HandbotCamera
{
  using Interface = CCI_HandBotCameraSensor;
  static constexpr const char* kLabel = "handbot_camera";
  static CameraModel Model() { return {CameraModel::View::kAhead, {0.09, 0, 0.1}, 0, 0}; }
};

template <class Interface>
class Camera : public Interface
{
public:
  Camera(OnDemandSensor& batch, std::size_t k) : batch_(batch), k_(k) {}
  std::span<const CCI_ColourBlob> GetAllBlobs() const override
  {
    batch_.Want(k_);
    return blobs;
  }
  std::vector<CCI_ColourBlob> blobs;

private:
  OnDemandSensor& batch_;
  std::size_t k_;
};

// Makes the blob of a source. `distance` is measured in the plane of the robot's base.
CCI_ColourBlob BlobAt(CameraModel::View view, const Vector3& place, std::uint32_t colour, double angle, double distance)
{
  CCI_ColourBlob blob;
  blob.colour = colour;
  blob.angle_rad = angle;
  blob.distance_m = distance;
  if (view == CameraModel::View::kDown) return blob;
  blob.distance_m = __builtin_sqrt(place.squaredNorm());
  blob.elevation_rad = Atan2(place.z(), distance);
  return blob;
}

template <class Traits>
class CameraBatch : public ColourCamera
{
public:
  Camera<typename Traits::Interface>* Sensor(std::size_t k) override { return &cameras_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override { values.SetList(cameras_[k].blobs); }

protected:
  void InitBatch(const DeviceSetup& setup)
  {
    CameraModel model = Traits::Model();
    if constexpr (requires { Traits::kHasHeight; }) model.eye.z() = setup.parameters.Number("height");
    if constexpr (requires { Traits::kHasPosition; }) model.eye = setup.parameters.Vector3Of("position");
    InitCamera(setup, model);
    cameras_.reserve(setup.robots.size());
    for (std::size_t k = 0; k < setup.robots.size(); ++k) cameras_.emplace_back(*this, k);
    if (model_.view != CameraModel::View::kTurned) return;
    for (const std::uint32_t robot : setup.robots)
      directions_.push_back(
          {setup.space.GetEntity(robot).SlotOf("laser_pan"), setup.space.GetEntity(robot).SlotOf("laser_tilt")});
  }
  // The camera shares its unit with the laser: the tilt is from straight down, and pan is the direction of the tilt.
  Vector3 AxisOf(std::size_t k) const override
  {
    const SinCos pan = SinCosOf(space_->Attributes()[directions_[k].pan]);
    const SinCos tilt = SinCosOf(space_->Attributes()[directions_[k].tilt]);
    return {tilt.sin * pan.cos, tilt.sin * pan.sin, -tilt.cos};
  }
  // Returns the axes of the image of robot k, in its frame: x along the line of sight, y level and to the left.
  Eigen::Matrix3d ImageOf(std::size_t k) const
  {
    const SinCos pan = SinCosOf(space_->Attributes()[directions_[k].pan]);
    Eigen::Matrix3d axes;
    axes.col(0) = AxisOf(k);
    axes.col(1) = Vector3(-pan.sin, pan.cos, 0);
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
  }
  std::vector<Camera<typename Traits::Interface>> cameras_;

private:
  struct Slots
  {
    std::uint32_t pan, tilt;
  };
  std::vector<Slots> directions_;  // of each robot, if they turn
};

// A camera with exact positions and noise on the readings.
template <class Traits>
class IdealCamera : public CameraBatch<Traits>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->InitBatch(setup);
    distance_noise_ = NoiseFrom(setup.parameters, "distance_");
    angle_noise_ = NoiseFrom(setup.parameters, "angle_");
    if (kHasElevation) elevation_noise_ = NoiseFrom(setup.parameters, "elevation_");
    distance_streams_ = DeviceStreams(setup, "distance");
    angle_streams_ = DeviceStreams(setup, "angle");
    elevation_streams_ = DeviceStreams(setup, "elevation");
  }

protected:
  void Extract(std::size_t k, const ColourCamera::Seen& seen, std::size_t first, std::size_t behind) override
  {
    auto& blobs = this->cameras_[k].blobs;
    blobs.resize(behind - first);
    for (std::size_t i = first; i < behind; ++i)
      blobs[i - first] = BlobAt(this->model_.view, seen.Place(i), this->Sources().Source(seen.source[i]).colour,
                                seen.angle[i], seen.distance[i]);
    if (!distance_noise_.IsActive() && !angle_noise_.IsActive() && !elevation_noise_.IsActive()) return;
    names_.clear();
    for (std::size_t i = first; i < behind; ++i) names_.push_back(this->Sources().NameOf(seen.source[i]));
    samples_.resize(names_.size());
    const auto disturb = [&](const NoiseModel& noise, const DeviceStreams& streams, const auto& add)
    {
      if (!noise.IsActive()) return;
      streams.Sample(noise, k, names_, samples_);
      for (std::size_t i = 0; i < samples_.size(); ++i) add(blobs[i], samples_[i]);
    };
    using Blob = CCI_ColourBlob;
    disturb(distance_noise_, distance_streams_,
            [](Blob& blob, double noise) { blob.distance_m = std::max(blob.distance_m + noise, 0.0); });
    disturb(angle_noise_, angle_streams_,
            [](Blob& blob, double noise) { blob.angle_rad = WrapAngle(blob.angle_rad + noise); });
    disturb(elevation_noise_, elevation_streams_,
            [](Blob& blob, double noise)
            { blob.elevation_rad = std::clamp(blob.elevation_rad + noise, -kPi / 2, kPi / 2); });
  }

private:
  // Cameras that look down report no elevation.
  inline static const bool kHasElevation = Traits::Model().view != CameraModel::View::kDown;

  NoiseModel distance_noise_, angle_noise_, elevation_noise_;
  DeviceStreams distance_streams_, angle_streams_, elevation_streams_;
  std::vector<std::uint64_t> names_;  // of the blobs of one robot
  std::vector<double> samples_;
};

// The place of a blob in the image, in whole pixels with noise, turned back into readings; some blobs are missed.
// Looking down, the distance from the middle of the image is proportional to the angle from the axis; looking ahead, to
// its tangent.
template <class Traits>
class PixelCamera : public CameraBatch<Traits>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->InitBatch(setup);
    noise_ = NoiseFrom(setup.parameters);
    image_radius_ = setup.parameters.Number("image_radius");
    miss_ = setup.parameters.Number("miss_probability");
    streams_ = DeviceStreams(setup, "pixels");
    miss_streams_ = DeviceStreams(setup, "miss");
  }

protected:
  void Extract(std::size_t k, const ColourCamera::Seen& seen, std::size_t first, std::size_t behind) override
  {
    auto& blobs = this->cameras_[k].blobs;
    blobs.clear();
    for (std::size_t i = first; i < behind; ++i)
    {
      const std::uint64_t name = IsRandom() ? this->Sources().NameOf(seen.source[i]) : 0;
      if (miss_ > 0 && miss_streams_.Of(k, name).Uniform() < miss_) continue;
      RandomStream random = streams_.Of(k, name);
      const Vector3 place = Pixels(k, seen.Place(i), random);
      blobs.push_back(BlobAt(this->model_.view, place, this->Sources().Source(seen.source[i]).colour,
                             Atan2(place.y(), place.x()),
                             __builtin_sqrt(place.x() * place.x() + place.y() * place.y())));
    }
  }

private:
  bool IsRandom() const { return noise_.IsActive() || miss_ > 0; }

  double Pixel(double coordinate, RandomStream& random) const
  {
    constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52: adding and subtracting it rounds
    return (coordinate + noise_.Sample(random) + kRounder) - kRounder;
  }

  Vector3 Pixels(std::size_t k, const Vector3& place, RandomStream& random) const
  {
    switch (this->model_.view)
    {
      case CameraModel::View::kDown:
        return Down(place, random);
      case CameraModel::View::kAhead:
        break;
      case CameraModel::View::kTurned:
        const Eigen::Matrix3d axes = this->ImageOf(k);
        return axes * Ahead(axes.transpose() * place, random);
    }
    return Ahead(place, random);
  }
  Vector3 Down(const Vector3& place, RandomStream& random) const
  {
    const double along_floor = __builtin_sqrt(place.x() * place.x() + place.y() * place.y());
    const double per_radian = image_radius_ / this->model_.aperture;
    const double from_middle = Atan2(along_floor, -place.z()) * per_radian;
    const double scale = along_floor > 0 ? from_middle / along_floor : 0;
    const double u = Pixel(scale * place.x(), random);
    const double v = Pixel(scale * place.y(), random);
    const double radius = std::min(__builtin_sqrt(u * u + v * v), image_radius_);
    if (radius == 0) return {0, 0, place.z()};
    const SinCos angle = SinCosOf(radius / per_radian);
    const double floor = -place.z() * angle.sin / angle.cos;
    const double length = __builtin_sqrt(u * u + v * v);
    return {u / length * floor, v / length * floor, place.z()};
  }
  Vector3 Ahead(const Vector3& place, RandomStream& random) const
  {
    const SinCos aperture = SinCosOf(this->model_.aperture);
    const double per_tangent = image_radius_ * aperture.cos / aperture.sin;
    const double u = Pixel(place.y() / place.x() * per_tangent, random) / per_tangent;
    const double v = Pixel(place.z() / place.x() * per_tangent, random) / per_tangent;
    return {place.x(), place.x() * u, place.x() * v};
  }

  NoiseModel noise_;
  DeviceStreams streams_, miss_streams_;
  double image_radius_ = 0;
  double miss_ = 0;
};

template <class Traits>
void BindCameras()
{
  const std::string label = Traits::kLabel;
  BindSensor<IdealCamera<Traits>>(label, "generic_" + label);
  BindSensor<PixelCamera<Traits>>(label, "pixel_noise_" + label);
}

}  // namespace

const DeviceCode kColourCamerasCode(
    []
    {
      BindCameras<FootbotCamera>();
      BindSensor<IdealCamera<Argos3FootbotCamera>>(FootbotCamera::kLabel, "argos3_footbot_omnidirectional_camera");
      BindCameras<FootbotPerspectiveCamera>();
      BindCameras<EyebotCamera>();
      BindCameras<EyebotPanTiltCamera>();
      BindCameras<HandbotCamera>();
    });

}  // namespace swarmanoid
