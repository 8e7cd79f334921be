// Drivers of the cameras: colour blobs from a cloud of coloured points in the frame of the robot (x ahead, y left, z
// up, REP 103).
#include <array>
#include <optional>
#include <stdexcept>

#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_camera_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_pan_tilt_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_perspective_camera_sensor.h"
#include "common/control_interface/handbot/ci_handbot_camera_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/point_cloud.h"

namespace swarmanoid::ros2
{
namespace
{

struct ColouredPoint
{
  Vector3 place;             // m
  std::uint32_t colour = 0;  // 0xRRGGBB
};

// Reads the points of a cloud with positions and rgb (float32 or uint32, 0x00RRGGBB).
class PointReader
{
public:
  PointReader(const DriverSetup& setup, const std::string& topic) : subscriber_(setup, topic) {}

  // Returns false if no new cloud has come.
  bool Poll(std::vector<ColouredPoint>& points)
  {
    if (!subscriber_.TakeLatest()) return false;
    const PointCloud cloud(subscriber_.Latest(), subscriber_.Name());
    points.clear();
    if (cloud.Size() == 0) return true;
    const PointPlaces places(cloud);
    const std::size_t rgb = cloud.OffsetOf("rgb", {PointCloud::Type::kFloat32, PointCloud::Type::kUint32});
    for (std::size_t k = 0; k < cloud.Size(); ++k)
    {
      ColouredPoint point{places.At(k)};
      cloud.Copy(k, rgb, &point.colour);
      point.colour &= 0xffffff;
      points.push_back(point);
    }
    return true;
  }
  DriverSource Source() const { return subscriber_.Source(); }

private:
  Subscriber<PointCloud2> subscriber_;
};

double Length(double x, double y) { return __builtin_sqrt(x * x + y * y); }

// A camera. If AHEAD is true, it looks ahead, so that distances are along the line of sight.
template <class Interface, bool AHEAD>
class Camera : public CSensorDriver, public Interface
{
public:
  void Init(const DriverSetup& setup) override { reader_.emplace(setup, setup.parameters.Text("topic")); }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const CCI_ColourBlob> GetAllBlobs() const override { return blobs_; }
  void Poll() override
  {
    if (!reader_->Poll(points_)) return;
    blobs_.clear();
    for (const auto& [place, colour] : points_)
    {
      const double flat = Length(place.x(), place.y());
      CCI_ColourBlob blob{colour, flat, Atan2(place.y(), place.x()), 0};
      if (AHEAD)
      {
        blob.distance_m = Length(flat, place.z());
        blob.elevation_rad = Atan2(place.z(), flat);
      }
      blobs_.push_back(blob);
    }
  }
  std::vector<DriverSource> Sources() const override { return {reader_->Source()}; }

private:
  std::optional<PointReader> reader_;
  std::vector<ColouredPoint> points_;
  std::vector<CCI_ColourBlob> blobs_;
};

using FootbotCamera = Camera<CCI_FootBotOmnidirectionalCameraSensor, false>;
using FootbotPerspectiveCamera = Camera<CCI_FootBotPerspectiveCameraSensor, true>;
using EyebotCamera = Camera<CCI_EyeBotCameraSensor, false>;
using PanTiltCamera = Camera<CCI_EyeBotPanTiltCameraSensor, true>;
using HandbotCamera = Camera<CCI_HandBotCameraSensor, true>;

PluginDescription DescribeCamera(const std::string& type, const std::string& robot,
                                 std::vector<ParameterSpec> parameters = {})
{
  parameters.push_back(TopicParameter("topic", "blobs", "Topic of the blobs."));
  return DescribeDriver(type, "ros2", "sensor_msgs/msg/PointCloud2 (x, y, z, rgb) on blobs", {robot},
                        std::move(parameters));
}

REGISTER_SENSOR_DRIVER(FootbotCamera, DescribeCamera("footbot_omnidirectional_camera", "footbot"))
REGISTER_SENSOR_DRIVER(FootbotPerspectiveCamera, DescribeCamera("footbot_perspective_camera", "footbot"))
REGISTER_SENSOR_DRIVER(EyebotCamera, DescribeCamera("eyebot_camera", "eyebot"))
REGISTER_SENSOR_DRIVER(PanTiltCamera, DescribeCamera("eyebot_pan_tilt_camera", "eyebot"))
REGISTER_SENSOR_DRIVER(HandbotCamera, DescribeCamera("handbot_camera", "handbot"))

constexpr std::array<std::uint32_t, 7> kColours{CCI_Colour::RED,    CCI_Colour::GREEN, CCI_Colour::BLUE,
                                                CCI_Colour::YELLOW, CCI_Colour::CYAN,  CCI_Colour::MAGENTA,
                                                CCI_Colour::WHITE};

class PieCamera : public CSensorDriver, public CCI_PieCameraSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    reader_.emplace(setup, setup.parameters.Text("topic"));
    sectors_ = static_cast<unsigned>(setup.parameters.Integer("sectors"));
    slices_.resize(kColours.size() * sectors_);
  }
  CCI_Sensor* Sensor() override { return this; }
  unsigned GetNumSectors() const override { return sectors_; }
  std::span<const Slice> GetAllSlices(std::uint32_t colour) const override
  {
    const std::size_t place = PlaceOf(colour);
    if (place == kColours.size())
      throw std::invalid_argument("the pie camera tells red, green, blue, yellow, cyan, magenta and white apart");
    return {&slices_[place * sectors_], sectors_};
  }
  void Poll() override
  {
    if (!reader_->Poll(points_)) return;
    std::ranges::fill(slices_, Slice{});
    for (const auto& [place, colour] : points_)
    {
      const std::size_t hue = PlaceOf(CCI_Colour::Nearest(colour));
      if (hue == kColours.size()) continue;
      double angle = Atan2(place.y(), place.x());
      if (angle < 0) angle += 2 * kPi;
      const auto sector = std::min(static_cast<unsigned>(angle * (sectors_ / (2 * kPi))), sectors_ - 1);
      Slice& slice = slices_[hue * sectors_ + sector];
      slice.distance_m = std::min(slice.distance_m, Length(place.x(), place.y()));
      ++slice.blobs;
    }
  }
  std::vector<DriverSource> Sources() const override { return {reader_->Source()}; }

private:
  static std::size_t PlaceOf(std::uint32_t colour)
  {
    return static_cast<std::size_t>(std::ranges::find(kColours, colour) - kColours.begin());
  }

  std::optional<PointReader> reader_;
  std::vector<ColouredPoint> points_;
  unsigned sectors_ = 12;
  std::vector<Slice> slices_;  // by colour, one after the other
};

REGISTER_SENSOR_DRIVER(PieCamera, DescribeCamera("pie_camera", "footbot",
                                                 {{.name = "sectors",
                                                   .type = ParameterType::kInteger,
                                                   .default_value = "12",
                                                   .description = "Number of equal sectors around the robot.",
                                                   .minimum = 1,
                                                   .maximum = 360}}))

}  // namespace
}  // namespace swarmanoid::ros2
