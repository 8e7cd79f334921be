// ros2_render: publishes a simulation as ROS 2 topics: /clock, /tf, /tf_static, <robot>/odom and markers. It uses the
// names and types of ROS 2 over DDS (real_robot/drivers/ros2/ros2_endpoints.h), for RViz, rosbag2 and nodes of users.
// It takes no commands.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "common/experiment/entity_kind.h"
#include "common/space/shape.h"
#include "common/space/space.h"
#include "nav_msgs.h"
#include "real_robot/drivers/ros2/ros2_messages.h"
#include "rosgraph_msgs.h"
#include "tf2_msgs.h"
#include "visualiser/render.h"
#include "visualiser/renderer_library.h"
#include "visualization_msgs.h"

namespace swarmanoid
{
namespace
{

using Clock = rosgraph_msgs::msg::dds_::Clock_;
using TFMessage = tf2_msgs::msg::dds_::TFMessage_;
using Odometry = nav_msgs::msg::dds_::Odometry_;
using Marker = visualization_msgs::msg::dds_::Marker_;
using MarkerArray = visualization_msgs::msg::dds_::MarkerArray_;
using Time = builtin_interfaces::msg::dds_::Time_;

// RViz does not request markers that were sent before it started, so they are sent again.
constexpr auto kMarkerPeriod = std::chrono::seconds(1);
constexpr int kCube = 1, kSphere = 2, kCylinder = 3;
constexpr int kAdd = 0, kDelete = 2;
constexpr double kThin = 0.002;  // m: the thickness of painted areas of the floor

template <class Vector>
void SetVector(Vector& to, const Vector3& from)
{
  to.x(from.x());
  to.y(from.y());
  to.z(from.z());
}

void SetQuaternion(geometry_msgs::msg::dds_::Quaternion_& to, const Quaternion& from)
{
  to.x(from.x());
  to.y(from.y());
  to.z(from.z());
  to.w(from.w());
}

class CRos2Render : public CRender
{
public:
  void Init(const RenderSetup& setup) override
  {
    space_ = &setup.space;
    every_ = static_cast<std::uint64_t>(setup.parameters.Integer("every"));
    frame_ = setup.parameters.Text("frame");
    name_space_ = setup.parameters.Text("namespace");
    clock_.emplace("rt/clock", ros2::TypeOf<Clock>());
    transforms_.emplace("rt/tf", ros2::TypeOf<TFMessage>());
    statics_.emplace("rt/tf_static", ros2::TypeOf<TFMessage>(), ros2::Writer::Keeps::kLatched);
    if (setup.parameters.Boolean("markers"))
      markers_.emplace(ros2::TopicName(name_space_, "arena"), ros2::TypeOf<MarkerArray>(),
                       ros2::Writer::Keeps::kLatched);
    for (const std::uint32_t e : space_->Movable())
    {
      Moving& moving = moving_.emplace_back();
      moving.entity = e;
      if (setup.parameters.Boolean("odometry") && HasOdometryHere(e))
        moving.odometry = std::make_unique<ros2::Writer>(OdometryTopic(e), ros2::TypeOf<Odometry>());
    }
    message_.transforms().reserve(moving_.size());
  }

  void Draw() override
  {
    const Time now = ros2::TimeOf(space_->GetTime());
    Clock clock;
    clock.clock(now);
    clock_->Write(&clock);
    if (!statics_told_) PublishStatics(now);
    statics_told_ = true;
    if (space_->GetTick() % every_ == 0) PublishPoses(now);
    PublishMarkers(now);
  }
  void Idle() override { PublishMarkers(ros2::TimeOf(space_->GetTime())); }

  void Finish() override
  {
    for (std::optional<ros2::Writer>* writer : {&clock_, &transforms_, &statics_, &markers_})
      if (*writer) (*writer)->Flush();
  }

private:
  struct Moving
  {
    std::uint32_t entity = 0;
    std::unique_ptr<ros2::Writer> odometry;
    std::optional<std::uint64_t> tick;  // the tick of the previous pose
    Pose pose;
  };

  // Robots that a node controls publish the odometry of their wheels on the same topic.
  bool HasOdometryHere(std::uint32_t entity) const
  {
    const CSwarmanoidSpaceEntity& robot = space_->GetEntity(entity);
    if (!IsRobot(robot.GetKind())) return false;
    const ControllerConfiguration* controller =
        space_->GetExperiment().FindController(robot.GetConfiguration().controller);
    return controller == nullptr || controller->tag != "ros2_controller";
  }

  // Ids may contain '.', '-' and ':', which topic names must not.
  std::string OdometryTopic(std::uint32_t robot)
  {
    std::string topic = ros2::TopicName(name_space_, ros2::TopicWord(space_->GetEntity(robot).GetId()) + "/odom");
    if (!topics_.insert(topic).second)
      throw std::runtime_error(
          fmt::format("ros2_render: the topic {} would be that of two robots; '{}' needs another id, because . - and : "
                      "are _ in the names of topics",
                      topic.substr(2), space_->GetEntity(robot).GetId()));
    return topic;
  }

  void AddTransform(TFMessage& message, std::uint32_t entity, const Pose& pose, const Time& now) const
  {
    auto& transform = message.transforms().emplace_back();
    transform.header().stamp(now);
    transform.header().frame_id(frame_);
    transform.child_frame_id(space_->GetEntity(entity).GetId());
    SetVector(transform.transform().translation(), pose.position);
    SetQuaternion(transform.transform().rotation(), pose.orientation);
  }

  // Publishes static transforms once; DDS keeps them for later subscribers.
  void PublishStatics(const Time& now)
  {
    TFMessage message;
    for (std::uint32_t e = 0; e < space_->Size(); ++e)
      if (!space_->GetEntity(e).IsMovable()) AddTransform(message, e, space_->GetPose(e), now);
    statics_->Write(&message);
  }

  void PublishPoses(const Time& now)
  {
    message_.transforms().clear();
    for (Moving& moving : moving_)
    {
      if (!space_->IsPresent(moving.entity))
      {
        moving.tick.reset();
        continue;
      }
      const Pose pose = space_->GetPose(moving.entity);
      AddTransform(message_, moving.entity, pose, now);
      if (moving.odometry) PublishOdometry(moving, pose, now);
      moving.tick = space_->GetTick();
      moving.pose = pose;
    }
    transforms_->Write(&message_);
  }

  // Velocities are computed from the motion since the previous pose, in the frame of the robot.
  void PublishOdometry(const Moving& moving, const Pose& pose, const Time& now)
  {
    Odometry odometry;
    odometry.header().stamp(now);
    odometry.header().frame_id(frame_);
    odometry.child_frame_id(space_->GetEntity(moving.entity).GetId());
    SetVector(odometry.pose().pose().position(), pose.position);
    SetQuaternion(odometry.pose().pose().orientation(), pose.orientation);
    if (moving.tick && *moving.tick < space_->GetTick())
    {
      const double seconds = static_cast<double>(space_->GetTick() - *moving.tick) * space_->GetTickSeconds();
      const Pose way = moving.pose.Inverse().Compose(pose);
      // The motion is a circle: its chord points along the heading at half the way, and is shorter than the arc.
      const Eigen::AngleAxisd turn(way.orientation);
      const double half = turn.angle() / 2;
      const Vector3 chord = Eigen::AngleAxisd(-half, turn.axis()) * way.position;
      SetVector(odometry.twist().twist().linear(), chord * (half > 1e-9 ? half / std::sin(half) : 1) / seconds);
      SetVector(odometry.twist().twist().angular(), turn.axis() * (turn.angle() / seconds));
    }
    moving.odometry->Write(&odometry);
  }

  void PublishMarkers(const Time& now)
  {
    if (!markers_) return;
    const auto absent = space_->Absent();
    const bool changed = !std::equal(absent.begin(), absent.end(), absent_.begin(), absent_.end());
    const auto time = std::chrono::steady_clock::now();
    if (!changed && shown_at_ && time - *shown_at_ < kMarkerPeriod) return;
    shown_at_ = time;
    absent_.assign(absent.begin(), absent.end());
    MarkerArray array;
    const Vector3& size = space_->GetExperiment().arena_size;
    Marker& floor = array.markers().emplace_back();
    Fill(floor, now, frame_, "floor", 0, kCube, 0xdcdfe2);
    SetVector(floor.pose().position(), {size.x() / 2, size.y() / 2, -kThin});
    floor.pose().orientation().w(1);
    SetVector(floor.scale(), {size.x(), size.y(), kThin});
    for (std::uint32_t e = 0; e < space_->Size(); ++e) AddMarker(array, e, now);
    markers_->Write(&array);
  }

  static void Fill(Marker& marker, const Time& now, const std::string& frame, const std::string& group, int id,
                   int type, std::uint32_t colour)
  {
    marker.header().stamp(now);
    marker.header().frame_id(frame);
    marker.ns(group);
    marker.id(id);
    marker.type(type);
    marker.action(kAdd);
    marker.frame_locked(true);
    const auto channel = [&](unsigned shift) { return static_cast<float>(colour >> shift & 0xff) / 255.0F; };
    marker.color().r(channel(16));
    marker.color().g(channel(8));
    marker.color().b(channel(0));
    marker.color().a(1);
  }

  // Markers of moving bodies are in the frame of the body, so that they move with /tf.
  void AddMarker(MarkerArray& array, std::uint32_t e, const Time& now) const
  {
    const CSwarmanoidSpaceEntity& entity = space_->GetEntity(e);
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    const Vector3& size = entity.GetSize();
    int type = kCube;
    Vector3 scale = size, centre = Vector3::Zero();
    switch (kind.role)
    {
      case EntityRole::kRobot:
      case EntityRole::kObject:
        if (kind.form == BodyForm::kCylinder)
        {
          type = kCylinder;
          scale = {2 * size.x(), 2 * size.x(), size.z()};
        }
        if (kind.origin == BodyOrigin::kBase) centre.z() = scale.z() / 2;
        break;
      case EntityRole::kPatch:
      case EntityRole::kHole:
        type = size.y() == 0 ? kCylinder : kCube;
        scale = size.y() == 0 ? Vector3(2 * size.x(), 2 * size.x(), kThin) : Vector3(size.x(), size.y(), kThin);
        break;
      case EntityRole::kLight:
      case EntityRole::kSound:
        type = kSphere;
        scale = Vector3::Constant(0.1);
        break;
      case EntityRole::kTerrain:
        return;
    }
    std::uint32_t colour = kind.role == EntityRole::kHole ? 0 : kind.colour;
    if (FindAttribute(entity.GetKind(), "colour") != nullptr)
      colour = static_cast<std::uint32_t>(entity.GetAttribute("colour"));
    const bool moves = entity.IsMovable();
    Marker& marker = array.markers().emplace_back();
    Fill(marker, now, moves ? entity.GetId() : frame_, std::string(TagName(entity.GetKind())), static_cast<int>(e),
         type, colour);
    if (!space_->IsPresent(e)) marker.action(kDelete);
    const Pose place = moves ? Pose{centre, Quaternion::Identity()}
                             : Pose{entity.GetPose().Apply(centre), entity.GetPose().orientation};
    SetVector(marker.pose().position(), place.position);
    SetQuaternion(marker.pose().orientation(), place.orientation);
    SetVector(marker.scale(), scale);
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::uint64_t every_ = 1;
  std::string frame_, name_space_;
  std::optional<ros2::Writer> clock_, transforms_, statics_, markers_;
  bool statics_told_ = false;
  std::vector<Moving> moving_;
  std::set<std::string> topics_;
  TFMessage message_;
  std::vector<std::uint32_t> absent_;  // the absent entities when the markers were sent last
  std::optional<std::chrono::steady_clock::time_point> shown_at_;
};

}  // namespace
}  // namespace swarmanoid

EXPORT_RENDERER(::swarmanoid::CRos2Render)
