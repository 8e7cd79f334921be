#include "real_robot/drivers/ros2/ros2_messages.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace swarmanoid::ros2
{

ParameterSpec TopicParameter(const std::string& name, const std::string& value, const std::string& what)
{
  return {.name = name, .type = ParameterType::kText, .default_value = value, .description = what};
}

ParameterSpec NumberParameter(const std::string& name, const std::string& unit, const std::string& value,
                              const std::string& what)
{
  return {.name = name, .unit = unit, .default_value = value, .description = what, .minimum = 0};
}

ColorRGBA ToMessage(std::uint32_t colour)
{
  const auto channel = [colour](unsigned shift) { return static_cast<float>(colour >> shift & 0xff) / 255.0F; };
  ColorRGBA message;
  message.r(channel(16));
  message.g(channel(8));
  message.b(channel(0));
  message.a((colour & 0xffffff) == 0 ? 0.0F : 1.0F);
  return message;
}

std::uint32_t ToColour(const ColorRGBA& message)
{
  const auto channel = [](float value)
  { return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F); };
  return channel(message.r()) << 16 | channel(message.g()) << 8 | channel(message.b());
}

builtin_interfaces::msg::dds_::Time_ TimeOf(double seconds)
{
  const auto nanoseconds = std::llround(seconds * 1e9);
  builtin_interfaces::msg::dds_::Time_ time;
  time.sec(static_cast<std::int32_t>(nanoseconds / 1'000'000'000));
  time.nanosec(static_cast<std::uint32_t>(nanoseconds % 1'000'000'000));
  return time;
}

std_msgs::msg::dds_::Header_ HeaderOfNow(const std::string& frame)
{
  timespec time{};
  clock_gettime(CLOCK_REALTIME, &time);
  std_msgs::msg::dds_::Header_ header;
  header.stamp().sec(static_cast<std::int32_t>(time.tv_sec));
  header.stamp().nanosec(static_cast<std::uint32_t>(time.tv_nsec));
  header.frame_id(frame);
  return header;
}

void NumberPublisher::Publish(double value)
{
  Float64 message;
  message.data(value);
  publisher_.Publish(message);
}

void SwitchPublisher::Publish(bool value)
{
  Bool message;
  message.data(value);
  publisher_.Publish(message);
}

JointReader::JointReader(const DriverSetup& setup, const std::string& topic, std::vector<std::string> joints)
    : subscriber_(setup, topic)
{
  for (std::string& name : joints) joints_.push_back({.name = std::move(name), .latest_at = Now()});
}

void JointReader::Poll()
{
  while (subscriber_.TakeNext())
  {
    const JointState& message = subscriber_.Latest();
    for (Joint& joint : joints_)
    {
      const auto found = std::ranges::find(message.name(), joint.name);
      if (found == message.name().end()) continue;
      const auto place = static_cast<std::size_t>(found - message.name().begin());
      if (place < message.position().size()) joint.position = message.position()[place];
      if (place < message.velocity().size()) joint.velocity = message.velocity()[place];
      joint.heard = true;
      joint.latest_at = Now();
    }
  }
}

void JointReader::AddSources(std::vector<DriverSource>& sources) const
{
  for (const Joint& joint : joints_)
    sources.push_back({subscriber_.Name() + ", joint " + joint.name, joint.heard, Now() - joint.latest_at});
}

}  // namespace swarmanoid::ros2
