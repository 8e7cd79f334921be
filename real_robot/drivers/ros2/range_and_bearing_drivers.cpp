// Drivers of range and bearing. Received packets come as points with bytes, in the frame of the robot (x ahead, y left,
// z up, REP 103). Bytes to send are published.
#include <optional>

#include "common/control_interface/ci_range_and_bearing.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/point_cloud.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

constexpr std::size_t kBytes = CCI_RangeAndBearingActuator::NUM_BYTES;

class RangeAndBearingReceiver : public CSensorDriver, public CCI_RangeAndBearingSensor
{
public:
  void Init(const DriverSetup& setup) override { heard_.emplace(setup, setup.parameters.Text("topic")); }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const Packet> GetAllPackets() const override { return packets_; }
  // A packet is valid for one step: the next one of the controller.
  void Poll() override
  {
    packets_.clear();
    while (heard_->TakeNext()) Add(PointCloud(heard_->Latest(), heard_->Name()));
  }
  std::vector<DriverSource> Sources() const override { return {heard_->Source()}; }

private:
  void Add(const PointCloud& cloud)
  {
    if (cloud.Size() == 0) return;
    const PointPlaces places(cloud);
    const std::size_t bytes = cloud.OffsetOf("data", {PointCloud::Type::kUint8}, kBytes);
    for (std::size_t k = 0; k < cloud.Size(); ++k)
    {
      const Vector3 place = places.At(k);
      const double flat = __builtin_sqrt(place.x() * place.x() + place.y() * place.y());
      Packet& packet = packets_.emplace_back();
      packet.range_m = __builtin_sqrt(flat * flat + place.z() * place.z());
      packet.bearing_rad = Atan2(place.y(), place.x());
      packet.vertical_bearing_rad = Atan2(place.z(), flat);
      cloud.Copy(k, bytes, packet.message.data(), kBytes);
    }
  }

  std::optional<Subscriber<PointCloud2>> heard_;
  std::vector<Packet> packets_;
};

REGISTER_SENSOR_DRIVER(RangeAndBearingReceiver,
                       DescribeDriver("range_and_bearing", "ros2",
                                      "sensor_msgs/msg/PointCloud2 (x, y, z, data: 10 bytes) on range_and_bearing", {},
                                      {TopicParameter("topic", "range_and_bearing",
                                                      "Topic of the packets that were heard; an empty cloud if there "
                                                      "are none.")}))

using UInt8MultiArray = std_msgs::msg::dds_::UInt8MultiArray_;

class RangeAndBearingSender : public TopicActuator<CCI_RangeAndBearingActuator, Publisher<UInt8MultiArray>>
{
public:
  void Init(const DriverSetup& setup) override
  {
    output_.emplace(setup, setup.parameters.Text("topic"));
    layout_.resize(1);
    layout_[0].label("byte");
  }
  void SetMessage(const Message& message) override { message_ = message; }
  void StopSending() override { message_.reset(); }
  void Push() override
  {
    Publish(message_ ? std::span<const std::uint8_t>(*message_) : std::span<const std::uint8_t>());
  }
  void Stop() override { Publish({}); }

private:
  // Without bytes, nothing is sent.
  void Publish(std::span<const std::uint8_t> bytes)
  {
    layout_[0].size(static_cast<std::uint32_t>(bytes.size()));
    layout_[0].stride(layout_[0].size());
    array_.layout().dim(layout_);
    array_.data().assign(bytes.begin(), bytes.end());
    output_->Publish(array_);
  }

  std::optional<Message> message_;
  std::vector<std_msgs::msg::dds_::MultiArrayDimension_> layout_;
  UInt8MultiArray array_;
};

REGISTER_ACTUATOR_DRIVER(RangeAndBearingSender,
                         DescribeDriver("range_and_bearing", "ros2",
                                        "std_msgs/msg/UInt8MultiArray (10 bytes, or none) on range_and_bearing/send",
                                        {},
                                        {TopicParameter("topic", "range_and_bearing/send",
                                                        "Topic of the bytes to send until others come.")}))

}  // namespace
}  // namespace swarmanoid::ros2
