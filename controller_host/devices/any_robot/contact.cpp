// The contact sensor: it reports where the outline of a robot, seen from above, is within a small distance of another
// body. The body must be of the robot's engines and at the same height. The result is exact for upright bodies; tilted
// ones have their outline turned to their heading. Generic.
#include <algorithm>
#include <array>
#include <memory>

#include "common/control_interface/ci_contact_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"

namespace swarmanoid
{
namespace
{

// A disc, or a rectangle by its corners, counter-clockwise.
struct Outline
{
  bool is_disc = true;
  Vector2 centre = Vector2::Zero();
  double radius = 0;
  std::array<Vector2, 4> corners{};
};

Outline OutlineOf(const BodyShape& shape, const Pose& pose)
{
  Outline outline;
  const Vector3 centre = pose.Apply(shape.centre);
  outline.centre = {centre.x(), centre.y()};
  outline.is_disc = shape.kind == Shape::Kind::kCylinder;
  outline.radius = shape.half_size.x();
  if (outline.is_disc) return outline;
  const SinCos yaw = SinCosOf(YawOf(pose.orientation));
  const Vector2 ahead = shape.half_size.x() * Vector2(yaw.cos, yaw.sin);
  const Vector2 left = shape.half_size.y() * Vector2(-yaw.sin, yaw.cos);
  outline.corners = {outline.centre + ahead + left, outline.centre - ahead + left, outline.centre - ahead - left,
                     outline.centre + ahead - left};
  return outline;
}

struct Approach
{
  double gap = 0;  // m; 0 where they overlap
  Vector2 place = Vector2::Zero();
};

// Returns the direction and distance from a point to a rectangle.
Approach Nearest(const Vector2& point, const Outline& box)
{
  Approach nearest{-1, point};
  bool is_inside = true;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Vector2& start = box.corners[i];
    const Vector2 edge = box.corners[(i + 1) % 4] - start;
    const Vector2 from_start = point - start;
    is_inside &= edge.x() * from_start.y() - edge.y() * from_start.x() >= 0;
    const double part = std::clamp(from_start.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vector2 place = start + part * edge;
    const double gap = __builtin_sqrt((point - place).squaredNorm());
    if (nearest.gap < 0 || gap < nearest.gap) nearest = {gap, place};
  }
  if (is_inside) nearest.gap = 0;
  return nearest;
}

Approach DiscToBox(const Outline& disc, const Outline& box)
{
  Approach nearest = Nearest(disc.centre, box);
  nearest.gap = std::max(nearest.gap - disc.radius, 0.0);
  return nearest;
}

Approach Between(const Outline& a, const Outline& b)
{
  if (a.is_disc && b.is_disc)
  {
    const Vector2 way = b.centre - a.centre;
    const double distance = __builtin_sqrt(way.squaredNorm());
    const Vector2 place = distance > 0 ? Vector2(a.centre + way * (a.radius / distance)) : a.centre;
    return {std::max(distance - a.radius - b.radius, 0.0), place};
  }
  if (a.is_disc) return DiscToBox(a, b);
  if (b.is_disc) return DiscToBox(b, a);
  Approach nearest = Nearest(a.corners[0], b);
  const auto look_at = [&](const Vector2& corner, const Outline& box)
  {
    const Approach here = Nearest(corner, box);
    if (here.gap < nearest.gap) nearest = here;
  };
  for (const Vector2& corner : a.corners) look_at(corner, b);
  for (const Vector2& corner : b.corners) look_at(corner, a);
  return nearest;
}

struct Contacts : public CCI_ContactSensor
{
  std::span<const double> GetAllContacts() const override { return angles; }
  std::vector<double> angles;
};

class ContactSensor : public SensorBatch
{
public:
  void Init(const DeviceSetup& setup) override
  {
    space_ = &setup.space;
    robots_ = setup.robots;
    world_ = SensorWorld::Of(setup.space);
    reach_ = setup.parameters.Number("reach");
    noise_ = NoiseFrom(setup.parameters);
    streams_ = DeviceStreams(setup);
    for (const std::uint32_t robot : robots_) widest_ = std::max(widest_, world_->Body(robot).radius);
    fixed_ = std::make_unique<FixedBodies>(setup.space, world_->Bodies(), widest_ + reach_);
    names_ = world_->Names();
    contacts_.resize(robots_.size());
  }
  Contacts* Sensor(std::size_t k) override { return &contacts_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override { values.SetList(contacts_[k].angles); }
  double Reach() const override { return widest_ + reach_; }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k) Feel(k);
  }

private:
  void Feel(std::size_t k)
  {
    const std::uint32_t robot = robots_[k];
    std::vector<double>& angles = contacts_[k].angles;
    angles.clear();
    if (!space_->IsPresent(robot)) return;
    const BodyShape& own = world_->Body(robot);
    const Pose pose = space_->GetPose(robot);
    const Outline outline = OutlineOf(own, pose);
    const double heading = YawOf(pose.orientation);
    const auto look_at = [&](std::uint32_t body)
    {
      if (body == robot || !world_->Membership().ShareEngine(robot, body)) return;
      const BodyShape& other = world_->Body(body);
      const Pose place = space_->GetPose(body);
      const double below = place.position.z() + other.low - (pose.position.z() + own.high);
      const double above = pose.position.z() + own.low - (place.position.z() + other.high);
      if (below > reach_ || above > reach_) return;
      const Approach approach = Between(outline, OutlineOf(other, place));
      if (approach.gap > reach_) return;
      double angle = Atan2(approach.place.y() - pose.position.y(), approach.place.x() - pose.position.x()) - heading;
      if (noise_.IsActive()) angle += noise_.Sample(streams_.Of(k, names_[body]));
      angles.push_back(WrapAngle(angle));
    };
    world_->Grid().ForEachNear(pose.position.x(), pose.position.y(), widest_ + reach_, look_at);
    for (const std::uint32_t body : fixed_->Near(pose.position.x(), pose.position.y())) look_at(body);
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> robots_;
  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<FixedBodies> fixed_;
  std::span<const std::uint64_t> names_;
  double reach_ = 0, widest_ = 0;  // m
  NoiseModel noise_;
  DeviceStreams streams_;
  std::vector<Contacts> contacts_;
};

}  // namespace

const DeviceCode kContactCode([] { BindSensor<ContactSensor>("contact", "generic_contact"); });

}  // namespace swarmanoid
