// Shared code for messages of ROS 2: parameters, colours, time stamps, joints.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry_msgs.h"
#include "real_robot/drivers/ros2/ros2_endpoints.h"
#include "sensor_msgs.h"
#include "std_msgs.h"

namespace swarmanoid::ros2
{

using Bool = std_msgs::msg::dds_::Bool_;
using Float64 = std_msgs::msg::dds_::Float64_;
using ColorRGBA = std_msgs::msg::dds_::ColorRGBA_;
using Float32MultiArray = std_msgs::msg::dds_::Float32MultiArray_;
using Twist = geometry_msgs::msg::dds_::Twist_;
using JointState = sensor_msgs::msg::dds_::JointState_;

// Returns a parameter that names a topic.
ParameterSpec TopicParameter(const std::string& name, const std::string& value, const std::string& what);
ParameterSpec NumberParameter(const std::string& name, const std::string& unit, const std::string& value,
                              const std::string& what);

// These functions convert 0xRRGGBB to channels of 0 to 1, with alpha 0 for black, else 1, and back.
ColorRGBA ToMessage(std::uint32_t colour);
std::uint32_t ToColour(const ColorRGBA& message);

// Returns seconds of simulated time as a time stamp.
builtin_interfaces::msg::dds_::Time_ TimeOf(double seconds);

// Returns a header with the time of day, as ROS 2 stamps messages.
std_msgs::msg::dds_::Header_ HeaderOfNow(const std::string& frame);

// Publishes one number on a topic.
class NumberPublisher
{
public:
  NumberPublisher(const DriverSetup& setup, const std::string& topic) : publisher_(setup, topic) {}
  void Publish(double value);
  std::string Name() const { return publisher_.Name(); }

private:
  Publisher<Float64> publisher_;
};

class SwitchPublisher
{
public:
  SwitchPublisher(const DriverSetup& setup, const std::string& topic) : publisher_(setup, topic) {}
  void Publish(bool value);
  std::string Name() const { return publisher_.Name(); }

private:
  Publisher<Bool> publisher_;
};

// Reads positions and velocities of some joints from a topic of sensor_msgs/msg/JointState. Each message may have other
// joints.
class JointReader
{
public:
  JointReader(const DriverSetup& setup, const std::string& topic, std::vector<std::string> joints);
  void Poll();
  double Position(std::size_t joint) const { return joints_[joint].position; }
  double Velocity(std::size_t joint) const { return joints_[joint].velocity; }
  // Adds one source for each joint.
  void AddSources(std::vector<DriverSource>& sources) const;

private:
  struct Joint
  {
    std::string name;
    double position = 0;
    double velocity = 0;
    bool heard = false;
    double latest_at = 0;
  };
  Subscriber<JointState> subscriber_;
  std::vector<Joint> joints_;
};

}  // namespace swarmanoid::ros2
