// The cameras: colour blobs as a cloud of coloured points in the frame of the robot (x ahead, y left, z up, REP 103).
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/eyebot/ci_eyebot_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/handbot/ci_handbot_camera_sensor.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/ros2_messages.h"

namespace swarmanoid::ros2
{
namespace
{

using PointCloud2 = sensor_msgs::msg::dds_::PointCloud2_;

struct ColouredPoint
{
  std::array<double, 3> place{};  // m
  std::uint32_t colour = 0;       // 0xRRGGBB
};

// The points of a cloud with the fields x, y, z (float32) and rgb (float32 or uint32, 0x00RRGGBB).
class PointReader
{
public:
  PointReader(const DriverSetup& setup, const std::string& topic) : subscriber_(setup, topic) {}

  // False if nothing new came.
  bool Poll(std::vector<ColouredPoint>& points)
  {
    if (!subscriber_.TakeLatest()) return false;
    const PointCloud2& cloud = subscriber_.Latest();
    const std::array<std::size_t, 4> offsets{OffsetOf("x"), OffsetOf("y"), OffsetOf("z"), OffsetOf("rgb")};
    const std::size_t row = std::size_t{cloud.width()} * cloud.point_step();
    if (cloud.is_bigendian() != (std::endian::native == std::endian::big) || cloud.row_step() < row ||
        cloud.data().size() < std::size_t{cloud.height()} * cloud.row_step())
      throw DriverError(subscriber_.Name() + ": the data do not fit height, row_step, point_step and byte order");
    points.clear();
    for (std::size_t k = 0; k < std::size_t{cloud.height()} * cloud.width(); ++k)
    {
      const std::uint8_t* bytes =
          cloud.data().data() + k / cloud.width() * cloud.row_step() + k % cloud.width() * cloud.point_step();
      ColouredPoint point;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        float value = 0;
        std::memcpy(&value, bytes + offsets[axis], sizeof(value));
        point.place[axis] = static_cast<double>(value);
      }
      std::memcpy(&point.colour, bytes + offsets[3], sizeof(point.colour));
      point.colour &= 0xffffff;
      points.push_back(point);
    }
    return true;
  }
  DriverSource Source() const { return subscriber_.Source(); }

private:
  std::size_t OffsetOf(const std::string& name) const
  {
    constexpr std::uint8_t kUint32 = 6;
    constexpr std::uint8_t kFloat32 = 7;
    const PointCloud2& cloud = subscriber_.Latest();
    for (const auto& field : cloud.fields())
    {
      if (field.name() != name) continue;
      if (field.datatype() != kFloat32 && !(name == "rgb" && field.datatype() == kUint32)) break;
      if (field.offset() + std::size_t{4} <= cloud.point_step()) return field.offset();
    }
    throw DriverError(subscriber_.Name() + ": the points need the field " + name + " as float32" +
                      (name == "rgb" ? " or uint32" : ""));
  }

  Subscriber<PointCloud2> subscriber_;
};

double Length(double x, double y) { return __builtin_sqrt(x * x + y * y); }

// `AHEAD`: the camera looks ahead, so that distances are along the line of sight.
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
      const double flat = Length(place[0], place[1]);
      CCI_ColourBlob blob{colour, flat, Atan2(place[1], place[0]), 0};
      if (AHEAD)
      {
        blob.distance_m = Length(flat, place[2]);
        blob.elevation_rad = Atan2(place[2], flat);
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
using EyebotCamera = Camera<CCI_EyeBotCameraSensor, false>;
using HandbotCamera = Camera<CCI_HandBotCameraSensor, true>;

PluginDescription DescribeCamera(const std::string& type, const std::string& robot,
                                 std::vector<ParameterSpec> parameters = {})
{
  parameters.push_back(TopicParameter("topic", "blobs", "Topic of the blobs."));
  return DescribeDriver(type, "ros2", "sensor_msgs/msg/PointCloud2 (x, y, z, rgb) on blobs", {robot},
                        std::move(parameters));
}

REGISTER_SENSOR_DRIVER(FootbotCamera, DescribeCamera("footbot_omnidirectional_camera", "footbot"))
REGISTER_SENSOR_DRIVER(EyebotCamera, DescribeCamera("eyebot_camera", "eyebot"))
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
      double angle = Atan2(place[1], place[0]);
      if (angle < 0) angle += 2 * kPi;
      const auto sector = std::min(static_cast<unsigned>(angle * (sectors_ / (2 * kPi))), sectors_ - 1);
      Slice& slice = slices_[hue * sectors_ + sector];
      slice.distance_m = std::min(slice.distance_m, Length(place[0], place[1]));
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
  std::vector<Slice> slices_;  // colour after colour
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
