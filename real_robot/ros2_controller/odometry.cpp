#include "real_robot/ros2_controller/odometry.h"

#include "common/control_interface/ci_positioning_sensor.h"
#include "common/math/elementary.h"
#include "nav_msgs.h"

namespace swarmanoid::ros2
{
namespace
{

class Odometry : public ReadingPublisher
{
public:
  explicit Odometry(const ReadingSetup& setup) : wheels_(setup.wheels), publisher_(setup, "odom")
  {
    if (setup.robot->HasSensor("positioning"))
      positioning_ = &setup.robot->Sensor<CCI_PositioningSensor>("positioning");
  }

  void Publish(const Header& header) override
  {
    message_.header(header);
    message_.header().frame_id(positioning_ != nullptr ? "world" : header.frame_id() + "/odom");
    message_.child_frame_id(header.frame_id());
    if (positioning_ != nullptr)
      SetPose(positioning_->GetPosition(), positioning_->GetOrientation());
    else
    {
      const SinCos half = SinCosOf(wheels_->Heading() / 2);
      SetPose({wheels_->X(), wheels_->Y(), 0}, Quaternion(half.cos, 0, 0, half.sin));
    }
    if (wheels_ != nullptr)
    {
      message_.twist().twist().linear().x(wheels_->Forward());
      message_.twist().twist().angular().z(wheels_->Turn());
    }
    publisher_.Publish(message_);
  }
  unsigned Listeners() const override { return publisher_.Listeners(); }

private:
  void SetPose(const Vector3& place, const Quaternion& turned)
  {
    auto& pose = message_.pose().pose();
    pose.position().x(place.x());
    pose.position().y(place.y());
    pose.position().z(place.z());
    pose.orientation().x(turned.x());
    pose.orientation().y(turned.y());
    pose.orientation().z(turned.z());
    pose.orientation().w(turned.w());
  }

  const WheelOdometry* wheels_;
  const CCI_PositioningSensor* positioning_ = nullptr;
  nav_msgs::msg::dds_::Odometry_ message_;
  ReadingTopic<nav_msgs::msg::dds_::Odometry_> publisher_;
};

}  // namespace

std::unique_ptr<ReadingPublisher> MakeOdometry(const ReadingSetup& setup) { return std::make_unique<Odometry>(setup); }

}  // namespace swarmanoid::ros2
