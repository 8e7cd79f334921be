// Drivers of a footbot's wheels, which publish a velocity command, and of its encoders, which read odometry or joint
// states.
#include <algorithm>
#include <array>

#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "nav_msgs.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

std::vector<ParameterSpec> WithWheels(std::vector<ParameterSpec> others)
{
  others.push_back(NumberParameter("wheel_radius", "m", "0.029112741", "Radius of a wheel."));
  others.push_back(NumberParameter("interwheel_distance", "m", "0.14", "Distance between the two wheels."));
  return others;
}

class Wheels : public TopicActuator<CCI_FootBotWheelsActuator, Publisher<Twist>>
{
public:
  void Init(const DriverSetup& setup) override
  {
    output_.emplace(setup, setup.parameters.Text("topic"));
    radius_ = setup.parameters.Number("wheel_radius");
    distance_ = setup.parameters.Number("interwheel_distance");
    limit_ = setup.parameters.Number("max_speed") / radius_;
  }
  void SetFootBotWheelsAngularVelocity(double left, double right) override { wanted_ = {left, right}; }

  void Push() override
  {
    const double left = std::clamp(wanted_[0], -limit_, limit_) * radius_;
    const double right = std::clamp(wanted_[1], -limit_, limit_) * radius_;
    Command((left + right) / 2, (right - left) / distance_);
  }
  void Stop() override
  {
    Command(0, 0);
    output_->Flush();
  }

private:
  void Command(double forward, double turn)
  {
    Twist message;
    message.linear().x(forward);
    message.angular().z(turn);
    output_->Publish(message);
  }

  std::array<double, 2> wanted_{};  // rad/s
  double radius_ = 0;
  double distance_ = 0;
  double limit_ = 0;  // rad/s
};

REGISTER_ACTUATOR_DRIVER(
    Wheels, DescribeDriver("footbot_wheels", "ros2", "geometry_msgs/msg/Twist on cmd_vel", {"footbot"},
                           WithWheels({TopicParameter("topic", "cmd_vel", "Topic of the velocity command."),
                                       NumberParameter("max_speed", "m/s", "0.3", "Fastest speed of a wheel.")})))

using Odometry = nav_msgs::msg::dds_::Odometry_;

class OdometryEncoders : public TopicSensor<CCI_FootBotEncodersSensor, Odometry>
{
public:
  std::span<const double, 2> GetAllSensorReadings() const override { return velocities_; }

private:
  void Configure(const Parameters& parameters) override
  {
    radius_ = parameters.Number("wheel_radius");
    distance_ = parameters.Number("interwheel_distance");
  }
  void Read(const Odometry& message) override
  {
    const auto& twist = message.twist().twist();
    const double turning = twist.angular().z() * distance_ / 2;
    velocities_ = {(twist.linear().x() - turning) / radius_, (twist.linear().x() + turning) / radius_};
  }

  double radius_ = 0;
  double distance_ = 0;
  std::array<double, 2> velocities_{};
};

REGISTER_SENSOR_DRIVER(OdometryEncoders,
                       DescribeDriver("footbot_encoders", "ros2", "nav_msgs/msg/Odometry on odom", {"footbot"},
                                      WithWheels({TopicParameter("topic", "odom", "Topic of the odometry.")})))

class JointEncoders : public JointSensor<CCI_FootBotEncodersSensor>
{
public:
  void Init(const DriverSetup& setup) override
  {
    Listen(setup, {setup.parameters.Text("left_joint"), setup.parameters.Text("right_joint")});
  }
  std::span<const double, 2> GetAllSensorReadings() const override { return velocities_; }

private:
  void Update() override { velocities_ = {Velocity(0), Velocity(1)}; }

  std::array<double, 2> velocities_{};
};

REGISTER_SENSOR_DRIVER(
    JointEncoders,
    DescribeDriver("footbot_encoders", "ros2_joint_states", "sensor_msgs/msg/JointState on joint_states", {"footbot"},
                   {TopicParameter("topic", "joint_states", "Topic of the joint states."),
                    TopicParameter("left_joint", "left_wheel", "Name of the left wheel's joint."),
                    TopicParameter("right_joint", "right_wheel", "Name of the right wheel's joint.")}))

}  // namespace
}  // namespace swarmanoid::ros2
