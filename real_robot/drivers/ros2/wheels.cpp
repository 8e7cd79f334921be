// The wheels of a footbot as a velocity command, and its encoders from odometry or joint states.
#include <algorithm>
#include <array>
#include <optional>

#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "nav_msgs.h"
#include "real_robot/drivers/ros2/ros2_kit.h"

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

class Wheels : public CActuatorDriver, public CCI_FootBotWheelsActuator
{
public:
  void Init(const DriverSetup& setup) override
  {
    publisher_.emplace(setup, setup.parameters.Text("topic"));
    radius_ = setup.parameters.Number("wheel_radius");
    distance_ = setup.parameters.Number("interwheel_distance");
    limit_ = setup.parameters.Number("max_speed") / radius_;
  }
  CCI_Actuator* Actuator() override { return this; }
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
    publisher_->Flush();
  }
  std::vector<std::string> Sinks() const override { return {publisher_->Name()}; }

private:
  void Command(double forward, double turn)
  {
    Twist message;
    message.linear().x(forward);
    message.angular().z(turn);
    publisher_->Publish(message);
  }

  std::optional<Publisher<Twist>> publisher_;
  std::array<double, 2> wanted_{};  // rad/s
  double radius_ = 0;
  double distance_ = 0;
  double limit_ = 0;  // rad/s
};

REGISTER_ACTUATOR_DRIVER(
    Wheels, DescribeDriver("footbot_wheels", "ros2", "geometry_msgs/msg/Twist on cmd_vel", {"footbot"},
                           WithWheels({TopicParameter("topic", "cmd_vel", "Topic of the velocity command."),
                                       NumberParameter("max_speed", "m/s", "0.3", "Fastest speed of a wheel.")})))

class OdometryEncoders : public CSensorDriver, public CCI_FootBotEncodersSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    subscriber_.emplace(setup, setup.parameters.Text("topic"));
    radius_ = setup.parameters.Number("wheel_radius");
    distance_ = setup.parameters.Number("interwheel_distance");
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, 2> GetAllSensorReadings() const override { return velocities_; }
  void Poll() override
  {
    if (!subscriber_->TakeLatest()) return;
    const auto& twist = subscriber_->Latest().twist().twist();
    const double turning = twist.angular().z() * distance_ / 2;
    velocities_ = {(twist.linear().x() - turning) / radius_, (twist.linear().x() + turning) / radius_};
  }
  std::vector<DriverSource> Sources() const override { return {subscriber_->Source()}; }

private:
  std::optional<Subscriber<nav_msgs::msg::dds_::Odometry_>> subscriber_;
  double radius_ = 0;
  double distance_ = 0;
  std::array<double, 2> velocities_{};
};

REGISTER_SENSOR_DRIVER(OdometryEncoders,
                       DescribeDriver("footbot_encoders", "ros2", "nav_msgs/msg/Odometry on odom", {"footbot"},
                                      WithWheels({TopicParameter("topic", "odom", "Topic of the odometry.")})))

class JointEncoders : public CSensorDriver, public CCI_FootBotEncodersSensor
{
public:
  void Init(const DriverSetup& setup) override
  {
    joints_.emplace(setup, setup.parameters.Text("topic"),
                    std::vector{setup.parameters.Text("left_joint"), setup.parameters.Text("right_joint")});
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, 2> GetAllSensorReadings() const override { return velocities_; }
  void Poll() override
  {
    joints_->Poll();
    velocities_ = {joints_->Velocity(0), joints_->Velocity(1)};
  }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources;
    joints_->AddSources(sources);
    return sources;
  }

private:
  std::optional<JointReader> joints_;
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
