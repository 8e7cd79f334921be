// Drivers of the propulsion and the magnet of an eyebot.
#include <algorithm>
#include <optional>

#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

using PoseStamped = geometry_msgs::msg::dds_::PoseStamped_;

class Propellers : public CActuatorDriver, public CCI_EyeBotPropellersActuator
{
public:
  void Init(const DriverSetup& setup) override
  {
    velocity_topic_.emplace(setup, setup.parameters.Text("topic"));
    position_topic_.emplace(setup, setup.parameters.Text("position_topic"));
    frame_ = setup.parameters.Text("frame");
    speed_limit_ = setup.parameters.Number("max_speed");
    yaw_limit_ = DegreesToRadians(setup.parameters.Number("max_yaw_rate"));
  }
  CCI_Actuator* Actuator() override { return this; }

  void SetVelocity(double forward, double left, double up, double yaw_rate) override
  {
    to_position_ = false;
    const auto limited = [this](double speed) { return std::clamp(speed, -speed_limit_, speed_limit_); };
    velocity_.linear().x(limited(forward));
    velocity_.linear().y(limited(left));
    velocity_.linear().z(limited(up));
    velocity_.angular().z(std::clamp(yaw_rate, -yaw_limit_, yaw_limit_));
  }
  void SetPosition(const Vector3& position, double yaw) override
  {
    to_position_ = true;
    auto& pose = target_.pose();
    pose.position().x(position.x());
    pose.position().y(position.y());
    pose.position().z(position.z());
    const SinCos half = SinCosOf(yaw / 2);
    pose.orientation().z(half.sin);
    pose.orientation().w(half.cos);
  }
  void Push() override
  {
    if (!to_position_)
    {
      velocity_topic_->Publish(velocity_);
      return;
    }
    target_.header(HeaderOfNow(frame_));
    position_topic_->Publish(target_);
  }
  void Stop() override
  {
    Twist hover;
    velocity_topic_->Publish(hover);
    velocity_topic_->Flush();
  }
  std::vector<std::string> Sinks() const override { return {velocity_topic_->Name(), position_topic_->Name()}; }

private:
  std::optional<Publisher<Twist>> velocity_topic_;
  std::optional<Publisher<PoseStamped>> position_topic_;
  std::string frame_;
  double speed_limit_ = 0;
  double yaw_limit_ = 0;
  bool to_position_ = false;
  Twist velocity_;
  PoseStamped target_;
};

REGISTER_ACTUATOR_DRIVER(
    Propellers,
    DescribeDriver("eyebot_propellers", "ros2",
                   "geometry_msgs/msg/Twist on cmd_vel, geometry_msgs/msg/PoseStamped on goal_pose", {"eyebot"},
                   {TopicParameter("topic", "cmd_vel", "Topic of the velocity command, in the frame of the robot."),
                    TopicParameter("position_topic", "goal_pose", "Topic of the place to fly to."),
                    TopicParameter("frame", "map", "Frame of the places."),
                    NumberParameter("max_speed", "m/s", "1", "Fastest speed along each axis."),
                    NumberParameter("max_yaw_rate", "degrees/s", "90", "Fastest turn.")}))

class Attachment : public TopicActuator<CCI_EyeBotAttachmentActuator, SwitchPublisher>
{
public:
  void Init(const DriverSetup& setup) override { output_.emplace(setup, setup.parameters.Text("topic")); }
  void Attach() override { attach_ = true; }
  void Detach() override { attach_ = false; }
  void Push() override { output_->Publish(attach_); }
  void Stop() override {}  // a hanging robot must not fall

private:
  bool attach_ = false;
};

REGISTER_ACTUATOR_DRIVER(Attachment,
                         DescribeDriver("eyebot_attachment", "ros2", "std_msgs/msg/Bool on attach", {"eyebot"},
                                        {TopicParameter("topic", "attach", "Topic of whether the magnet is on.")}))

}  // namespace
}  // namespace swarmanoid::ros2
