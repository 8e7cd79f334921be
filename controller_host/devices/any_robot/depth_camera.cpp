// The depth camera of any robot: a ray through the middle of each pixel, against all bodies and terrains as other
// sensors meet them, and the floor. No graphics: images of a rasteriser differ between machines, these do not. Generic.
#include <algorithm>
#include <memory>
#include <optional>

#include "common/control_interface/ci_depth_camera_sensor.h"
#include "common/math/elementary.h"
#include "common/plugin_descriptions/led_cones.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/device_streams.h"
#include "controller_host/devices/sensing/floor_patches.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kTerrain = 0xb9ae9a;  // as it is drawn
constexpr double kNearFloor = 0.1;            // m: patches higher above the floor are not on it
constexpr double kLedRadius = 0.015;          // m: of the spot that a lit LED makes on its robot

using Pixel = CCI_DepthCameraSensor::Pixel;

class DepthCamera : public CCI_DepthCameraSensor
{
public:
  DepthCamera(OnDemandSensor& batch, std::size_t k, unsigned width, unsigned height, double field_of_view)
      : pixels(static_cast<std::size_t>(width) * height),
        batch_(batch),
        k_(k),
        width_(width),
        height_(height),
        field_of_view_(field_of_view)
  {
  }
  unsigned GetWidth() const override { return width_; }
  unsigned GetHeight() const override { return height_; }
  double GetFieldOfView() const override { return field_of_view_; }
  std::span<const Pixel> GetAllPixels() const override
  {
    batch_.Want(k_);
    return pixels;
  }

  std::vector<Pixel> pixels;

private:
  OnDemandSensor& batch_;
  std::size_t k_;
  unsigned width_, height_;
  double field_of_view_;
};

// The source of an entity's colour.
struct Surface
{
  static constexpr std::uint32_t kNoSlot = 0xffffffff;
  std::uint32_t colour = 0;             // without an attribute
  std::uint32_t colour_slot = kNoSlot;  // of its attribute
  const LedLayout* leds = nullptr;
  std::uint32_t led_slot = 0, turret_slot = kNoSlot;
  std::optional<LedCones> cones;
};

class DepthCameraSensor : public SensorBatch, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const Parameters& parameters = setup.parameters;
    space_ = &setup.space;
    robots_ = setup.robots;
    world_ = SensorWorld::Of(setup.space);
    depth_noise_ = NoiseFrom(parameters, "depth_");
    colour_noise_ = NoiseFrom(parameters, "colour_");
    depth_streams_ = DeviceStreams(setup, "depth");
    colour_streams_ = DeviceStreams(setup, "colour");
    range_ = parameters.Number("range");
    nearest_ = parameters.Number("nearest");
    place_ = parameters.Vector3Of("position");
    floor_colour_ = parameters.Colour("floor_colour");
    const auto width = static_cast<unsigned>(parameters.Integer("width"));
    const auto height = static_cast<unsigned>(parameters.Integer("height"));
    const double field_of_view = DegreesToRadians(parameters.Number("field_of_view"));
    MakeRays(width, height, field_of_view, SinCosOf(DegreesToRadians(parameters.Number("pan"))),
             SinCosOf(DegreesToRadians(parameters.Number("tilt"))));
    patches_ = FloorPatchesOf(setup.space);
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e) surfaces_.push_back(SurfaceOf(e));
    InitDemand(robots_.size());
    cameras_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) cameras_.emplace_back(*this, k, width, height, field_of_view);
  }
  DepthCamera* Sensor(std::size_t k) override { return &cameras_[k]; }
  // The depth is along the axis; the rays of the corners are the longest.
  double Reach() const override
  {
    double longest = 0;
    for (const Vector3& ray : rays_) longest = std::max(longest, ray.norm());
    return place_.norm() + range_ * longest;
  }

  void RefreshShared(WorkerPool* pool) override
  {
    world_->Refresh(pool);
    for (FloorPatch& patch : patches_) patch.pose = space_->GetPose(patch.entity);
  }
  void Update(const ChannelView&) override { MakeAhead(); }
  void Expose(std::size_t k, ExposedValues& values) override
  {
    values.SetList(cameras_[k].pixels.size(), &cameras_[k].pixels,
                   [](void* of, std::span<const std::uint8_t> kept)
                   {
                     for (std::size_t i = 0; i < kept.size(); ++i)
                       if (kept[i] == 0) (*static_cast<std::vector<Pixel>*>(of))[i] = {};
                   });
  }

private:
  void MakeDue() override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (IsDue(k)) Look(k);
  }
  bool MakeAlone(std::size_t k) override
  {
    Look(k);
    return true;
  }

  // Makes the rays in the frame of the robot, with a length of 1 m along the axis.
  void MakeRays(unsigned width, unsigned height, double field_of_view, const SinCos& pan, const SinCos& tilt)
  {
    const Vector3 axis(tilt.cos * pan.cos, tilt.cos * pan.sin, tilt.sin);
    const Vector3 left(-pan.sin, pan.cos, 0);
    const Vector3 up(-tilt.sin * pan.cos, -tilt.sin * pan.sin, tilt.cos);
    const SinCos half = SinCosOf(field_of_view / 2);
    const double of_pixel = 2 * half.sin / half.cos / width;
    for (unsigned row = 0; row < height; ++row)
      for (unsigned column = 0; column < width; ++column)
        rays_.push_back(axis + of_pixel * (width / 2.0 - column - 0.5) * left +
                        of_pixel * (height / 2.0 - row - 0.5) * up);
  }

  Surface SurfaceOf(std::uint32_t index) const
  {
    const CSwarmanoidSpaceEntity& entity = space_->GetEntity(index);
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    Surface surface;
    surface.colour = kind.role == EntityRole::kTerrain ? kTerrain : kind.colour;
    if (AttributeOffset(entity.GetKind(), "colour") >= 0) surface.colour_slot = entity.SlotOf("colour");
    if (!kind.leds) return surface;
    surface.leds = &*kind.leds;
    surface.led_slot = entity.SlotOf("led");
    if (kind.leds->on_turret) surface.turret_slot = entity.SlotOf("turret_angle");
    surface.cones = LedConesOf(space_->GetExperiment(), entity.GetConfiguration());
    return surface;
  }

  void Look(std::size_t k)
  {
    const std::uint32_t robot = robots_[k];
    const Pose pose = space_->GetPose(robot);
    const Vector3 eye = pose.Apply(place_);
    std::vector<Pixel>& pixels = cameras_[k].pixels;
    const Eigen::Matrix3d to_space = pose.orientation.toRotationMatrix();
    for (std::size_t i = 0; i < rays_.size(); ++i) pixels[i] = Seen(robot, eye, to_space * rays_[i]);
    AddNoise(k, pixels);
  }

  Pixel Seen(std::uint32_t robot, const Vector3& eye, const Vector3& ray) const
  {
    const SensorWorld::Met met = world_->FirstMet(eye + nearest_ * ray, eye + range_ * ray,
                                                  [robot](std::uint32_t body) { return body != robot; });
    const double body_depth = met.part <= 1 ? nearest_ + met.part * (range_ - nearest_) : 2 * range_;
    if (eye.z() > 0 && ray.z() < 0)
    {
      const double depth = eye.z() / -ray.z();
      if (depth >= nearest_ && depth <= range_ && depth < body_depth) return {depth, FloorColour(eye + depth * ray)};
    }
    if (met.part > 1) return {};
    return {body_depth, ColourOf(met.entity, eye, eye + body_depth * ray)};
  }

  std::uint32_t FloorColour(const Vector3& point) const
  {
    std::uint32_t colour = floor_colour_;
    for (const FloorPatch& patch : patches_)
    {
      const Vector3 offset = point - patch.pose.position;
      if (offset.x() * offset.x() + offset.y() * offset.y() > patch.radius * patch.radius) continue;
      if (__builtin_fabs(offset.z()) > kNearFloor || !space_->IsPresent(patch.entity)) continue;
      const Vector3 local = patch.pose.Inverse().Apply(point);
      if (!patch.Contains(local.x(), local.y())) continue;
      const std::uint32_t tint =
          patch.is_hole ? 0 : static_cast<std::uint32_t>(space_->Attributes()[patch.colour_slot]);
      colour = patch.is_hole ? 0 : patch.Colour(tint, local.x(), local.y());
    }
    return colour;
  }

  std::uint32_t ColourOf(std::uint32_t entity, const Vector3& eye, const Vector3& point) const
  {
    const Surface& surface = surfaces_[entity];
    if (surface.leds != nullptr)
      if (const std::uint32_t led = LedColour(entity, surface, eye, point); led != 0) return led;
    if (surface.colour_slot == Surface::kNoSlot) return surface.colour;
    return static_cast<std::uint32_t>(space_->Attributes()[surface.colour_slot]);
  }

  // Returns the colour of the nearest lit LED whose spot covers the point and that faces the eye, or 0.
  std::uint32_t LedColour(std::uint32_t entity, const Surface& surface, const Vector3& eye, const Vector3& point) const
  {
    const SparseVector<double>& attributes = space_->Attributes();
    const Pose to_robot = space_->GetPose(entity).Inverse();
    const SinCos turret =
        surface.turret_slot == Surface::kNoSlot ? SinCos{0, 1} : SinCosOf(attributes[surface.turret_slot]);
    const auto on_ring = [&](const Vector3& in_space)
    {
      const Vector3 local = to_robot.Apply(in_space);
      return Vector3(turret.cos * local.x() + turret.sin * local.y(), turret.cos * local.y() - turret.sin * local.x(),
                     local.z());
    };
    const Vector3 spot = on_ring(point);
    const Vector3 from = on_ring(eye);
    std::uint32_t colour = 0;
    double nearest = kLedRadius * kLedRadius;
    for (std::size_t led = 0; led < surface.leds->places.size(); ++led)
    {
      const double lit = attributes[surface.led_slot + led];
      if (lit == 0) continue;
      const Vector2& place = surface.leds->places[led];
      const Vector3 at(place.x(), place.y(), surface.leds->height_m);
      const double square = (spot - at).squaredNorm();
      if (square > nearest) continue;
      const Vector3 way = from - at;
      if (surface.cones &&
          way.dot(surface.cones->axes[led]) < surface.cones->cosine * __builtin_sqrt(way.squaredNorm()))
        continue;
      nearest = square;
      colour = static_cast<std::uint32_t>(lit);
    }
    return colour;
  }

  void AddNoise(std::size_t k, std::vector<Pixel>& pixels)
  {
    const auto is_seen = [](const Pixel& pixel) { return pixel.depth_m < std::numeric_limits<double>::infinity(); };
    if (depth_noise_.IsActive())
    {
      samples_.resize(pixels.size());
      depth_streams_.Sample(depth_noise_, k, samples_);
      for (std::size_t i = 0; i < pixels.size(); ++i)
        if (is_seen(pixels[i])) pixels[i].depth_m = std::max(pixels[i].depth_m + samples_[i], 0.0);
    }
    if (!colour_noise_.IsActive()) return;
    samples_.resize(3 * pixels.size());
    colour_streams_.Sample(colour_noise_, k, samples_);
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      if (!is_seen(pixels[i])) continue;
      std::uint32_t colour = 0;
      for (unsigned channel = 0; channel < 3; ++channel)
      {
        const double value = (pixels[i].colour >> (16 - 8 * channel) & 0xff) + samples_[3 * i + channel];
        colour = colour << 8 | static_cast<std::uint32_t>(std::clamp(value, 0.0, 255.0) + 0.5);
      }
      pixels[i].colour = colour;
    }
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::shared_ptr<SensorWorld> world_;
  std::vector<Surface> surfaces_;  // by entity
  std::vector<FloorPatch> patches_;
  std::vector<Vector3> rays_;  // of each pixel
  double range_ = 0, nearest_ = 0;
  Vector3 place_ = Vector3::Zero();
  std::uint32_t floor_colour_ = 0;
  NoiseModel depth_noise_, colour_noise_;
  DeviceStreams depth_streams_, colour_streams_;
  std::vector<double> samples_;
  std::vector<DepthCamera> cameras_;
};

}  // namespace

const DeviceCode kDepthCamerasCode([] { BindSensor<DepthCameraSensor>("depth_camera", "generic_depth_camera"); });

}  // namespace swarmanoid
