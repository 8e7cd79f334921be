#include "common/plugin_descriptions/engine_bodies.h"

#include "common/math/elementary.h"
#include "common/plugin_descriptions/robot_parts.h"

namespace swarmanoid
{
namespace
{

double AttributeOf(const EntityConfiguration& entity, std::span<const double> attributes, std::string_view name,
                   std::size_t element = 0)
{
  std::size_t offset = element;
  for (const AttributeSpec& spec : DescriptionOf(entity.kind).attributes)
  {
    if (spec.name == name) return attributes[offset];
    offset += static_cast<std::size_t>(spec.count);
  }
  return 0;
}

// Adds the body of each shape. Sensors take a ball for a cylinder, and a hull for the box around it.
void AddShapes(const LinkBody& body, const Pose& motion, std::vector<CollisionBody>& bodies)
{
  for (const LinkShape& shape : body.shapes)
  {
    const Pose pose = motion.Compose(shape.pose);
    if (shape.form == LinkShape::Form::kSphere)
      bodies.push_back({true, pose, shape.size});
    else if (shape.form == LinkShape::Form::kCylinder)
      bodies.push_back({true, pose, {shape.size.x(), shape.size.x(), shape.size.z() / 2}});
    else
      bodies.push_back({false, pose, shape.size / 2});
  }
}

// The links where their joints are, and the base that carries them or the plain body.
void AddJointedBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies)
{
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  if (kind.base)
    AddShapes(*kind.base, {}, bodies);
  else
    AddPlainBody(entity, bodies);
  std::vector<double> positions;
  for (const MovingLink& link : kind.links) positions.push_back(AttributeOf(entity, attributes, link.attribute));
  const std::vector<Pose> motions = MotionsOfLinks(kind.links, positions);
  for (std::size_t k = 0; k < kind.links.size(); ++k) AddShapes(kind.links[k].body, motions[k], bodies);
}

Pose At(double x, double y, double z) { return {Vector3(x, y, z), Quaternion::Identity()}; }

void AddGripperSquare(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies)
{
  using S = GripperSquare;
  const Pose turret{Vector3(0, 0, entity.size.z() / 2),
                    QuaternionFromYaw(AttributeOf(entity, attributes, "turret_angle"))};
  bodies.push_back(
      {false, turret.Compose(At(S::kReach - S::kSide / 2, 0, 0)), {S::kSide / 2, S::kSide / 2, entity.size.z() / 2}});
}

bool HasTurret(const EntityConfiguration& entity)
{
  return DescriptionOf(entity.kind).mechanism == Mechanism::kTurretGripper;
}

}  // namespace

void Kinematics2dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                        std::vector<CollisionBody>& bodies)
{
  AddPlainBody(entity, bodies);
  if (!HasTurret(entity)) return;
  const WheelDrive& wheels = *DescriptionOf(entity.kind).wheels;
  const double half_height = entity.size.z() / 2;
  for (const double side : {1.0, -1.0})
    bodies.push_back(
        {true, At(0, side * wheels.axle_m / 2, half_height), {wheels.radius_m, wheels.radius_m, half_height}});
  AddGripperSquare(entity, attributes, bodies);
}

void Dynamics2dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies)
{
  AddPlainBody(entity, bodies);
  if (HasTurret(entity)) AddGripperSquare(entity, attributes, bodies);
}

void Dynamics3dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies)
{
  if (!DescriptionOf(entity.kind).links.empty()) return AddJointedBodies(entity, attributes, bodies);
  if (DescriptionOf(entity.kind).mechanism != Mechanism::kArms) return AddPlainBody(entity, bodies);
  using S = HandbotParts;
  bodies.push_back({false, At(0, 0, S::kBaseHeight / 2), {S::kBaseSide / 2, S::kBaseSide / 2, S::kBaseHeight / 2}});
  const double trunk = S::kHeight - S::kBaseHeight;
  bodies.push_back({false, At(0, 0, S::kBaseHeight + trunk / 2), {S::kTrunkLength / 2, S::kTrunkWidth / 2, trunk / 2}});
  for (std::size_t arm = 0; arm < 2; ++arm)
  {
    const Pose shoulder = HandbotShoulder(arm, AttributeOf(entity, attributes, "head_angle"),
                                          AttributeOf(entity, attributes, "arm", arm));
    // The axis of the cylinder lies along the arm.
    const Pose middle{Vector3(S::kArmLength / 2, 0, 0), QuaternionFromEuler({0, kPi / 2, 0})};
    bodies.push_back({true, shoulder.Compose(middle), {S::kArmRadius, S::kArmRadius, S::kArmLength / 2}});
  }
}

Pose HandbotShoulder(std::size_t arm, double head_angle, double aperture)
{
  using S = HandbotParts;
  const Pose head{Vector3(S::kHeadForward, 0, S::kHeadHeight), QuaternionFromEuler({head_angle, 0, 0})};
  const double side = arm == 0 ? 1 : -1;
  return head.Compose({Vector3(0, side * S::kShoulder, 0), QuaternionFromYaw(side * aperture)});
}

}  // namespace swarmanoid
