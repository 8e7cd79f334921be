// Problem: move the links of a robot by commands of position and speed, with limited speed and effort.
//
// Method: each joint is a hinge or a slider of ODE with stops at the ends of its range, and a motor beside it. A
// command moves a reference: to a position at the joint's largest speed, or at the commanded speed. The motor's speed
// is that of the reference and a gain times the distance to it, within the largest speed; the solver finds the effort
// that it takes, up to the limit. Damping is a torque against the joint's speed, as large as it is at the end of the
// step.
//
// Invariants: a reference is at most as far ahead of its joint as the motor goes at its largest speed in 1 /
// kJointGain, so a joint that was held back does not jump. The frames of all bodies have the axes of the entity while
// all joints are at 0. Positions always follow from the bodies alone. Source: docs/engines.md, "Joints" of
// `dynamics3d`.
#include "engine_worker/engines/dynamics3d/jointed.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"

namespace swarmanoid::dynamics3d
{
namespace
{

constexpr double kJointGain = 40;           // 1/s
constexpr double kReportedPosition = 1e-4;  // rad or m: smaller changes of positions are not reported

dMass MassOf(const LinkBody& body)
{
  const Eigen::Matrix3d& i = body.inertia;
  dMass mass;
  dMassSetParameters(&mass, body.mass_kg, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  return mass;
}

Pose CentreOf(const LinkBody& body) { return {body.centre_of_mass, Quaternion::Identity()}; }

// Returns the distance (m) from a point to the farthest point of the shapes of a body.
double RadiusAbout(const Vector3& point, const LinkBody& body)
{
  double radius = 0;
  for (const LinkShape& shape : body.shapes)
  {
    double half = shape.size.norm() / 2;
    if (shape.form == LinkShape::Form::kSphere) half = shape.size.x();
    if (shape.form == LinkShape::Form::kCylinder) half = Vector2(shape.size.x(), shape.size.z() / 2).norm();
    radius = std::max(radius, (shape.pose.position - point).norm() + half);
  }
  return radius;
}

void AddSolidsOf(OdeWorld& world, const LinkBody& body, int number)
{
  for (const LinkShape& shape : body.shapes)
  {
    Pose in_body{shape.pose.position - body.centre_of_mass, shape.pose.orientation};
    const Vector3& size = shape.size;
    std::shared_ptr<const HullShape> hull;
    dGeomID geom = nullptr;
    switch (shape.form)
    {
      case LinkShape::Form::kBox:
        geom = dCreateBox(nullptr, size.x(), size.y(), size.z());
        break;
      case LinkShape::Form::kCylinder:
        geom = dCreateCylinder(nullptr, size.x(), size.z());
        break;
      case LinkShape::Form::kSphere:
        geom = dCreateSphere(nullptr, size.x());
        break;
      case LinkShape::Form::kHull:
        hull = std::make_shared<const HullShape>(*shape.hull);
        geom = hull->MakeGeom();
        in_body = in_body.Compose({hull->Centre(), Quaternion::Identity()});
        break;
    }
    world.AddSolid(geom, number, ELayer::kRobot, ESurface::kPlain, in_body);
    world.KeepShape(std::move(hull));
  }
}

}  // namespace

JointedLinks::JointedLinks(Scene& scene, const CSwarmanoidSpaceEntity& entity, int base,
                           const std::function<int(const dMass&, const Pose&)>& add_body)
    : scene_(scene), entity_(entity), rows_(DescriptionOf(entity.GetKind()).links)
{
  OdeWorld& world = scene.world;
  const Vector3 base_centre = PoseOf(world.RecordOf(base).first).position;
  std::vector<double> reaches;  // from the base's centre of mass to the farthest point of each link, however joints are
  links_.reserve(rows_.size());
  for (const MovingLink& row : rows_)
  {
    Link link;
    link.row = &row;
    const Link* const carrier =
        row.parent == MovingLink::kBase ? nullptr : &links_[static_cast<std::size_t>(row.parent)];
    link.inner = carrier == nullptr ? base : carrier->body;
    const Vector3 inner_centre = carrier == nullptr ? base_centre : carrier->row->body.centre_of_mass;
    link.in_inner = row.body.centre_of_mass - inner_centre;
    link.body = add_body(MassOf(row.body), CentreOf(row.body));
    link.radius = RadiusAbout(row.body.centre_of_mass, row.body);
    // The joint turns apart what the two bodies are, which is harder than to turn both about their centres of mass.
    for (const int number : {link.body, link.inner})
    {
      const dMass& mass = world.RecordOf(number).mass;
      Eigen::Matrix3d inertia;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) inertia(r, c) = mass.I[4 * r + c];
      link.mobility += row.slides ? 1 / mass.mass : row.axis.dot(inertia.inverse() * row.axis);
    }
    const double effort = row.effort > 0 ? row.effort : row.friction;
    link.joint = world.AddJoint({.outer = link.body,
                                 .inner = link.inner,
                                 .anchor = row.anchor,
                                 .axis = row.axis,
                                 .slides = row.slides,
                                 .lowest = row.lowest,
                                 .highest = row.highest,
                                 .effort = effort});
    link.reference = link.position = row.Start();
    links_.push_back(link);

    const Vector3 from = carrier == nullptr ? base_centre : carrier->row->anchor;
    const double slide = row.slides ? std::max(std::abs(row.lowest), std::abs(row.highest)) : 0;
    const double to_anchor =
        (carrier == nullptr ? 0 : reaches[static_cast<std::size_t>(row.parent)]) + (row.anchor - from).norm() + slide;
    reaches.push_back(to_anchor);
    reach_ = std::max(reach_, to_anchor + RadiusAbout(row.anchor, row.body));
  }
  for (const MovingLink& row : rows_)
    if (row.effort > 0) swing_ = std::max(swing_, row.slides ? row.max_speed : row.max_speed * reach_);
}

void JointedLinks::AddSolids()
{
  for (const Link& link : links_) AddSolidsOf(scene_.world, link.row->body, link.body);
}

void JointedLinks::Put(const Pose& entity)
{
  std::vector<double> positions;
  for (const Link& link : links_) positions.push_back(link.position);
  const std::vector<Pose> motions = MotionsOfLinks(rows_, positions);
  for (std::size_t k = 0; k < links_.size(); ++k)
  {
    const dBodyID body = scene_.world.Body(links_[k].body);
    SetRawPose(body, RawOf(entity.Compose(motions[k]).Compose(CentreOf(rows_[k].body))));
    Stop(body);
  }
  for (Link& link : links_) link.reference = link.position;
  Measure();
}

void JointedLinks::FollowAttributes(const Pose& entity)
{
  for (Link& link : links_) link.position = entity_.GetAttribute(link.row->attribute);
  Put(entity);
}

void JointedLinks::Measure()
{
  for (Link& link : links_) link.position = PositionOf(link);
}

double JointedLinks::PositionOf(const Link& link) const
{
  const dBodyID inner = scene_.world.Body(link.inner), outer = scene_.world.Body(link.body);
  const Vector3& axis = link.row->axis;
  if (link.row->slides)
  {
    const Vector3 way = VectorOf(dBodyGetPosition(outer)) - VectorOf(dBodyGetPosition(inner));
    return axis.dot(VectorFromWorld(inner, way) - link.in_inner);
  }
  const Quaternion relative = PoseOf(inner).orientation.conjugate() * PoseOf(outer).orientation;
  return WrapAngle(2 * Atan2(relative.vec().dot(axis), relative.w()));
}

double JointedLinks::SpeedOf(const Link& link) const
{
  const dJointID joint = scene_.world.Hinge(link.joint);
  return link.row->slides ? dJointGetSliderPositionRate(joint) : dJointGetHingeAngleRate(joint);
}

void JointedLinks::Command(std::span<const double> values)
{
  for (std::size_t k = 0; k < links_.size(); ++k)
    links_[k].command = JointCommand::From(values.subspan(kJointCommandWidth * k, kJointCommandWidth));
}

void JointedLinks::Sense(std::span<double> values) const
{
  std::ranges::fill(values, 0.0);
  for (std::size_t k = 0; k < links_.size(); ++k)
  {
    values[kJointReadingWidth * k] = links_[k].position;
    values[kJointReadingWidth * k + 1] = SpeedOf(links_[k]);
    values[kJointReadingWidth * k + 2] = links_[k].effort;
  }
}

void JointedLinks::BeforeStep(double seconds)
{
  for (Link& link : links_)
  {
    if (link.row->effort > 0) Drive(link, seconds);
    if (link.row->damping > 0) Damp(link, seconds);
  }
}

void JointedLinks::Drive(Link& link, double seconds)
{
  const MovingLink& row = *link.row;
  const double next = NextReference(row, link.command, link.reference, seconds);
  const double rate = (next - link.reference) / seconds;
  const double lead = row.max_speed / kJointGain;
  const double ahead = row.IsEndless() ? WrapAngle(next - link.position) : next - link.position;
  const double way = std::clamp(ahead, -lead, lead);
  link.reference = row.IsEndless() ? WrapAngle(link.position + way) : row.Within(link.position + way);
  scene_.world.SetMotorSpeed(link.joint, std::clamp(rate + kJointGain * way, -row.max_speed, row.max_speed));
}

// The speed after the step decides, as far as this joint alone can tell: no damping makes the joint go back.
void JointedLinks::Damp(const Link& link, double seconds) const
{
  const double damping = link.row->damping;
  const double effort = -damping * SpeedOf(link) / (1 + damping * seconds * link.mobility);
  const dJointID joint = scene_.world.Hinge(link.joint);
  if (link.row->slides)
    dJointAddSliderForce(joint, effort);
  else
    dJointAddHingeTorque(joint, effort);
}

void JointedLinks::AfterStep()
{
  Measure();
  for (Link& link : links_) link.effort = scene_.world.MotorEffort(link.joint);
}

void JointedLinks::Report(AttributeReport& report) const
{
  for (const Link& link : links_) report.Set(link.row->attribute, link.position, 0, kReportedPosition);
}

void JointedLinks::Save(ByteWriter& state) const
{
  for (const Link& link : links_) state.Put(link.reference);
}

void JointedLinks::Load(ByteReader& state)
{
  for (Link& link : links_) link.reference = state.Get<double>();
  Measure();
}

void JointedLinks::SaveTick(ByteWriter& state) const
{
  for (const Link& link : links_)
  {
    state.Put(static_cast<std::uint8_t>(link.command.mode));
    state.Put(link.command.value);
    state.Put(link.effort);
  }
}

void JointedLinks::LoadTick(ByteReader& state)
{
  for (Link& link : links_)
  {
    link.command.mode = static_cast<JointCommand::Mode>(state.Get<std::uint8_t>());
    link.command.value = state.Get<double>();
    link.effort = state.Get<double>();
  }
}

double JointedLinks::LargestSpeed() const
{
  double largest = 0;
  for (const Link& link : links_)
  {
    const dBodyID body = scene_.world.Body(link.body);
    const double speed = std::sqrt(VectorOf(dBodyGetLinearVel(body)).squaredNorm());
    largest = std::max(largest, speed + link.radius * std::sqrt(VectorOf(dBodyGetAngularVel(body)).squaredNorm()));
  }
  return largest + swing_;
}

JointedModel::JointedModel(Scene& scene, const CSwarmanoidSpaceEntity& entity) : Model(scene, entity)
{
  const LinkBody& base = *DescriptionOf(entity.GetKind()).base;
  const auto add = [this](const dMass& mass, const Pose& in_entity)
  {
    AddBody(mass, in_entity, EBody::kMechanism);
    return bodies_.back().number;
  };
  const int number = add(MassOf(base), CentreOf(base));
  links_ = std::make_unique<JointedLinks>(scene, entity, number, add);
  scene.world.BeginEntity(Entity());
  AddSolidsOf(scene.world, base, number);
  links_->AddSolids();
}

void JointedModel::Place(const Pose& pose)
{
  Model::Place(pose);
  links_->Put(pose);
}

double JointedModel::LargestSpeed() const { return std::max(Model::LargestSpeed(), links_->LargestSpeed()); }

void JointedModel::Command(std::string_view channel, std::span<const double> values)
{
  if (channel == "joints") links_->Command(values);
}

void JointedModel::Sense(std::string_view channel, std::span<double> values) const
{
  if (channel == "joints") return links_->Sense(values);
  Model::Sense(channel, values);
}

}  // namespace swarmanoid::dynamics3d
