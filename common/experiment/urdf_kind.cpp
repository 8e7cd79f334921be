// A URDF file describes links and joints, and a kind has one body that carries others on joints. Two continuous joints
// about the lateral axis with round links are driven wheels: the middle of their axle on the ground becomes the origin.
// All shapes that no other joint moves then become one body: a cylinder if one upright cylinder covers them, a box
// around them if not, and their convex hull if a mesh is among them. A robot without such wheels stands on its links:
// its origin is below its root link, on the ground that its shapes touch when it starts, and its bodies keep their
// shapes.
//
// Invariant: what a file has and the kind leaves out or changes is named in a note; a mistake is an error with its
// line, and no kind is made.
#include "common/experiment/urdf_kind.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/experiment/urdf_links.h"
#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"

namespace swarmanoid
{
namespace
{

constexpr double kSamePlace = 1e-3;  // m
constexpr double kSpeed = 0.3;       // m/s, for wheels without a limit: that of WheelDrive
constexpr std::size_t kLongestName = 64;
constexpr double kMostTurn = 3.12;  // rad: a joint with stops cannot tell half a turn from minus half a turn
// Moments of inertia of a body satisfy the triangle inequality; files round them.
constexpr double kRounded = 1.05;

using Form = UrdfShape::Form;

// A robot has two driven wheels, left and right.
struct Wheels
{
  const UrdfJoint* left = nullptr;
  const UrdfJoint* right = nullptr;
  double radius = 0;
};

// It is the box around all shapes that were added, by its lower and its upper corner.
struct Extent
{
  Vector3 low = Vector3::Constant(1e9);
  Vector3 high = Vector3::Constant(-1e9);

  void Add(const UrdfShape& shape, const Pose& frame)
  {
    const Pose pose = frame.Compose(shape.pose);
    const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
    Vector3 half = Vector3::Zero();
    if (shape.form == Form::kMesh)
    {
      for (const Vector3& corner : shape.corners)
      {
        low = low.cwiseMin(pose.Apply(corner));
        high = high.cwiseMax(pose.Apply(corner));
      }
      return;
    }
    if (shape.form == Form::kBox) half = axes.cwiseAbs() * (shape.size / 2);
    if (shape.form == Form::kSphere) half = Vector3::Constant(shape.size.x());
    if (shape.form == Form::kCylinder)
      for (int i = 0; i < 3; ++i)
        half[i] = std::abs(axes(i, 2)) * shape.size.z() / 2 +
                  shape.size.x() * std::sqrt(std::max(0.0, 1 - axes(i, 2) * axes(i, 2)));
    low = low.cwiseMin(pose.position - half);
    high = high.cwiseMax(pose.position + half);
  }
};

// Returns points whose convex hull approximates a shape.
std::vector<Vector3> CornersOf(const UrdfShape& shape)
{
  if (shape.form == Form::kMesh) return shape.corners;
  std::vector<Vector3> corners;
  if (shape.form == Form::kBox)
  {
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5}) corners.push_back(shape.size.cwiseProduct(Vector3(x, y, z)));
    return corners;
  }
  // Cylinders become prisms with sixteen sides; a ball has six such rings, from pole to pole.
  constexpr int kSides = 16;
  const auto ring = [&](double radius, double z)
  {
    for (int k = 0; k < kSides; ++k)
    {
      const SinCos angle = SinCosOf(2 * kPi * k / kSides);
      corners.emplace_back(radius * angle.cos, radius * angle.sin, z);
    }
  };
  if (shape.form == Form::kCylinder)
  {
    for (const double side : {-0.5, 0.5}) ring(shape.size.x(), side * shape.size.z());
    return corners;
  }
  for (const double side : {-1.0, 1.0})
  {
    corners.emplace_back(0, 0, side * shape.size.x());
    for (const double height : {0.3, 0.8})
      ring(shape.size.x() * std::sqrt(1 - height * height), side * height * shape.size.x());
  }
  return corners;
}

class Builder
{
public:
  Builder(UrdfKind& result, const UrdfLinks& links) : result_(result), links_(links) {}

  void Build()
  {
    if (!FindWheels() || !FindMovingJoints()) return;
    if (wheels_.left != nullptr)
    {
      const UrdfLink& left = links_.LinkOf(wheels_.left->child);
      const UrdfLink& right = links_.LinkOf(wheels_.right->child);
      // The origin is the middle of the axle, on the ground.
      middle_ = (left.pose.position + right.pose.position) / 2;
      middle_.z() -= wheels_.radius;
      SetDrive();
      SetLinks();
      SetBody();
    }
    else
    {
      SetLinks();
      if (!result_.errors.empty()) return;
      StandOnGround();
    }
    SetMass();
    SetMesh();
  }

private:
  void Error(const SourceLocation& place, std::string text) { result_.errors.push_back({place, std::move(text)}); }
  void Note(const SourceLocation& place, std::string text) { result_.notes.push_back({place, std::move(text)}); }

  // Returns a pose of the root link in the frame of the kind.
  Pose InKind(const Pose& pose) const { return {pose.position - middle_, pose.orientation}; }

  static const UrdfShape* WheelShape(const UrdfLink& link)
  {
    for (const auto* shapes : {&link.collision, &link.visual})
      for (const UrdfShape& shape : *shapes)
        if (shape.form == Form::kCylinder || shape.form == Form::kSphere) return &shape;
    return nullptr;
  }

  static bool IsStill(const UrdfJoint& joint) { return joint.type == "fixed"; }

  bool IsAboutY(const UrdfJoint& joint) const
  {
    return std::abs((links_.LinkOf(joint.child).pose.orientation * joint.axis).y()) >= 1 - kSamePlace;
  }

  // Returns the joint whose child is a link; nullptr for the root.
  const UrdfJoint* JointAbove(const std::string& link) const
  {
    const auto found = std::ranges::find(links_.joints, link, &UrdfJoint::child);
    return found == links_.joints.end() ? nullptr : &*found;
  }

  // Finds the driven wheels: continuous joints about the axis to the left, with links that roll, on fixed links. If the
  // robot has other joints, another number of wheels makes it a robot without driven wheels.
  bool FindWheels()
  {
    std::vector<const UrdfJoint*> rolling;
    const UrdfJoint* no_shape = nullptr;
    bool has_others = false, has_any = false;
    for (const UrdfJoint& joint : links_.joints)
    {
      if (IsStill(joint)) continue;
      has_any = true;
      if (joint.type != "continuous" || !IsAboutY(joint))
      {
        has_others = true;
        continue;
      }
      if (WheelShape(links_.LinkOf(joint.child)) == nullptr)
        no_shape = no_shape == nullptr ? &joint : no_shape;
      else if (const UrdfJoint* above = JointAbove(joint.parent); above == nullptr || IsStill(*above))
        rolling.push_back(&joint);
    }
    if (rolling.size() == 2)
    {
      wheels_ = {rolling[0], rolling[1], 0};
      if (links_.LinkOf(wheels_.left->child).pose.position.y() < links_.LinkOf(wheels_.right->child).pose.position.y())
        std::swap(wheels_.left, wheels_.right);
      return CheckWheels();
    }
    if (has_others) return true;
    if (no_shape != nullptr)
    {
      Error(no_shape->location, fmt::format("the wheel '{}' of the joint '{}' needs a cylinder or a sphere in its "
                                            "<collision> or <visual>, which states its radius",
                                            no_shape->child, no_shape->name));
      return false;
    }
    std::vector<std::string> names;
    for (const UrdfJoint* joint : rolling) names.push_back(joint->name);
    Error(links_.location,
          fmt::format(
              "a robot has two driven wheels, which are continuous joints about y; this one has {}{}. {}",
              rolling.size(), names.empty() ? "" : ": " + Listed(names),
              has_any ? "Joints of casters are of type fixed" : "A robot on legs has revolute or prismatic joints"));
    return false;
  }

  bool CheckWheels()
  {
    const Pose& left = links_.LinkOf(wheels_.left->child).pose;
    const Pose& right = links_.LinkOf(wheels_.right->child).pose;
    const double radius = WheelShape(links_.LinkOf(wheels_.left->child))->size.x();
    wheels_.radius = WheelShape(links_.LinkOf(wheels_.right->child))->size.x();
    if (std::abs(radius - wheels_.radius) > kSamePlace)
      Error(wheels_.right->location,
            fmt::format("the wheels have radii of {:g} and {:g} m; they must be equal", radius, wheels_.radius));
    if (std::abs(left.position.x() - right.position.x()) > kSamePlace ||
        std::abs(left.position.z() - right.position.z()) > kSamePlace ||
        left.position.y() - right.position.y() < kSamePlace)
      Error(wheels_.right->location, fmt::format("the wheels '{}' and '{}' must face each other, left and right on one "
                                                 "axle",
                                                 wheels_.left->name, wheels_.right->name));
    return result_.errors.empty();
  }

  void SetDrive()
  {
    const double axle =
        links_.LinkOf(wheels_.left->child).pose.position.y() - links_.LinkOf(wheels_.right->child).pose.position.y();
    WheelDrive drive{axle, wheels_.radius, kSpeed};
    const auto velocity = [&](const UrdfJoint& wheel) -> std::optional<double>
    {
      if (!wheel.limit || !wheel.limit->velocity) return std::nullopt;
      if (!(*wheel.limit->velocity > 0))
        Error(wheel.limit->location, "the velocity of a joint's limit must be more than 0 rad/s");
      return wheel.limit->velocity;
    };
    const auto left = velocity(*wheels_.left);
    const auto right = velocity(*wheels_.right);
    if (left || right)
      drive.max_speed_m_s = std::min(left.value_or(1e9), right.value_or(1e9)) * wheels_.radius;
    else
      Note(wheels_.left->location,
           fmt::format("its wheels have no <limit velocity=\"…\"/> (rad/s); the fastest speed is {:g} m/s", kSpeed));
    result_.kind.wheels = drive;
  }

  // Finds the joints that move links, each after those that carry it. On a robot with driven wheels, joints without a
  // motor stand still: they are those of casters.
  bool FindMovingJoints()
  {
    std::vector<const UrdfJoint*> left;
    for (const UrdfJoint& joint : links_.joints)
    {
      if (IsStill(joint) || &joint == wheels_.left || &joint == wheels_.right) continue;
      if (wheels_.left != nullptr && !(joint.limit && joint.limit->effort.value_or(0) > 0))
      {
        Note(joint.location,
             fmt::format("the joint '{}' ({}) has no effort in its <limit>: on a robot with driven wheels "
                         "it stands still at zero",
                         joint.name, joint.type));
        continue;
      }
      CheckMotion(joint);
      left.push_back(&joint);
    }
    const auto is_left = [&](const UrdfLink& link)
    {
      for (const UrdfJoint* joint = JointAbove(link.name); joint != nullptr; joint = JointAbove(joint->parent))
        if (std::ranges::find(left, joint) != left.end()) return true;
      return false;
    };
    while (!left.empty())
    {
      const auto next =
          std::ranges::find_if(left, [&](const UrdfJoint* joint) { return !is_left(links_.LinkOf(joint->parent)); });
      moving_.push_back(*next);
      left.erase(next);
    }
    return result_.errors.empty();
  }

  void CheckMotion(const UrdfJoint& joint)
  {
    const auto is_good = [](char c)
    {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
             c == '.' || c == '/';
    };
    if (joint.name.empty() || joint.name.size() > kLongestName || !std::ranges::all_of(joint.name, is_good))
      Error(joint.location,
            fmt::format("the joint '{}' moves, so its name consists of 1 to {} letters, digits, '_', '-', "
                        "'.' and '/'",
                        joint.name, kLongestName));
    if (std::ranges::count(links_.joints, joint.name, &UrdfJoint::name) > 1)
      Error(joint.location, fmt::format("the joint '{}' is there twice", joint.name));
    const bool is_endless = joint.type == "continuous";
    if (!joint.limit)
    {
      if (!is_endless)
        Error(joint.location, fmt::format("the joint '{}' ({}) needs a <limit> with lower, upper, effort and velocity",
                                          joint.name, joint.type));
      return;
    }
    const UrdfLimit& limit = *joint.limit;
    if (!limit.effort || !limit.velocity || *limit.effort < 0 || *limit.velocity < 0 ||
        (*limit.effort > 0 && *limit.velocity == 0))
      Error(limit.location,
            fmt::format("the <limit> of the joint '{}' needs an 'effort' of 0 or more, and a 'velocity' "
                        "of more than 0 unless the effort is 0",
                        joint.name));
    if (is_endless) return;
    const double lower = limit.lower.value_or(0), upper = limit.upper.value_or(0);
    if (!(lower < upper))
      Error(limit.location,
            fmt::format("the <limit> of the joint '{}' goes from {:g} to {:g}; 'lower' must be less than "
                        "'upper'",
                        joint.name, lower, upper));
    if (joint.type == "revolute" && (lower < -kMostTurn || upper > kMostTurn))
      Error(limit.location,
            fmt::format("the <limit> of the joint '{}' goes from {:g} to {:g} rad; it must be within -{:g} "
                        "and {:g}, or the joint continuous",
                        joint.name, lower, upper, kMostTurn, kMostTurn));
    if (joint.friction > 0 && limit.effort.value_or(0) > 0)
      Note(joint.location,
           fmt::format("the friction of the joint '{}' has no effect: the effort of its motor is what the "
                       "friction leaves",
                       joint.name));
  }

  // Returns the number of the link with which a link of the file moves.
  int LinkNumberOf(const UrdfLink& link) const
  {
    for (const UrdfJoint* joint = JointAbove(link.name); joint != nullptr; joint = JointAbove(joint->parent))
      if (const auto found = std::ranges::find(moving_, joint); found != moving_.end())
        return static_cast<int>(found - moving_.begin());
    return MovingLink::kBase;
  }

  // Sets the links that joints move, and the base of a robot without driven wheels.
  void SetLinks()
  {
    EntityKindDescription& kind = result_.kind;
    kind.links.clear();
    for (const UrdfJoint* joint : moving_)
    {
      const UrdfLink& child = links_.LinkOf(joint->child);
      MovingLink link;
      link.joint = joint->name;
      link.attribute = "joint_" + joint->name;
      link.slides = joint->type == "prismatic";
      link.parent = LinkNumberOf(links_.LinkOf(joint->parent));
      link.anchor = InKind(child.pose).position;
      link.axis = (child.pose.orientation * joint->axis).normalized();
      if (joint->type != "continuous")
      {
        link.lowest = joint->limit->lower.value_or(0);
        link.highest = joint->limit->upper.value_or(0);
      }
      if (joint->limit)
      {
        link.effort = joint->limit->effort.value_or(0);
        link.max_speed = joint->limit->velocity.value_or(0);
      }
      link.damping = joint->damping;
      link.friction = link.effort > 0 ? 0 : joint->friction;
      link.body = BodyOf(static_cast<int>(kind.links.size()), fmt::format("by the joint '{}'", joint->name));
      kind.links.push_back(std::move(link));
    }
    if (wheels_.left == nullptr) kind.base = BodyOf(MovingLink::kBase, "as the base of its joints");
  }

  // Returns the body of all links of the file that move with a link.
  LinkBody BodyOf(int number, const std::string& how)
  {
    LinkBody body;
    const UrdfLink* first = nullptr;
    for (const UrdfLink& link : links_.links)
    {
      if (LinkNumberOf(link) != number) continue;
      if (first == nullptr || JointAbove(link.name) == nullptr ||
          std::ranges::find(moving_, JointAbove(link.name)) != moving_.end())
        first = &link;
      const Pose pose = InKind(link.pose);
      body.centre_of_mass += link.mass * pose.Apply(link.centre_of_mass);
      body.mass_kg += link.mass;
      for (const UrdfShape& shape : link.collision) body.shapes.push_back(ShapeOf(shape, pose));
      if (link.mass > 0 && !link.inertia)
        Error(link.location,
              fmt::format("the link '{}' moves {} and needs an <inertia> in its <inertial>", link.name, how));
    }
    if (!(body.mass_kg > 0))
    {
      Error(first->location,
            fmt::format("the link '{}' moves {} and needs an <inertial> with a <mass> of more than 0 kg and "
                        "an <inertia>",
                        first->name, how));
      return body;
    }
    body.centre_of_mass /= body.mass_kg;
    for (const UrdfLink& link : links_.links)
    {
      if (LinkNumberOf(link) != number || link.mass == 0) continue;
      const Pose pose = InKind(link.pose);
      const Eigen::Matrix3d turn = pose.orientation.toRotationMatrix();
      const Vector3 arm = pose.Apply(link.centre_of_mass) - body.centre_of_mass;
      body.inertia += turn * link.inertia.value_or(Eigen::Matrix3d::Zero()) * turn.transpose() +
                      link.mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
    }
    body.inertia = (body.inertia + body.inertia.transpose()).eval() / 2;
    const Vector3 moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvalues();
    if (!(moments.minCoeff() > 0 && 2 * moments.maxCoeff() <= moments.sum() * kRounded))
      Error(first->location,
            fmt::format("the inertia of the link '{}' has the principal moments {:g}, {:g} and {:g} kg m²; "
                        "those of a body are above 0, and none is larger than the other two together",
                        first->name, moments.x(), moments.y(), moments.z()));
    return body;
  }

  LinkShape ShapeOf(const UrdfShape& shape, const Pose& link)
  {
    LinkShape made;
    made.size = shape.size;
    made.pose = link.Compose(shape.pose);
    switch (shape.form)
    {
      case Form::kBox:
        break;
      case Form::kCylinder:
        made.form = LinkShape::Form::kCylinder;
        break;
      case Form::kSphere:
        made.form = LinkShape::Form::kSphere;
        break;
      case Form::kMesh:
      {
        made.form = LinkShape::Form::kHull;
        const Eigen::AlignedBox3d box =
            std::accumulate(shape.corners.begin(), shape.corners.end(), Eigen::AlignedBox3d(),
                            [](Eigen::AlignedBox3d all, const Vector3& corner) { return all.extend(corner); });
        std::vector<Vector3> corners = shape.corners;
        for (Vector3& corner : corners) corner -= box.center();
        made.size = box.sizes();
        made.pose = made.pose.Compose({box.center(), Quaternion::Identity()});
        made.hull = std::make_shared<const ConvexHull>(HullOf(corners));
      }
    }
    return made;
  }

  // The origin is below the root link, on the ground that the shapes touch with the joints where they start. The body
  // is the box about it that holds the shapes then.
  void StandOnGround()
  {
    EntityKindDescription& kind = result_.kind;
    std::vector<double> starts;
    for (const MovingLink& link : kind.links) starts.push_back(link.Start());
    const std::vector<Pose> motions = MotionsOfLinks(kind.links, starts);
    Extent all;
    for (const UrdfLink& link : links_.links)
    {
      const int number = LinkNumberOf(link);
      const Pose pose = InKind(link.pose);
      for (const UrdfShape& shape : link.collision)
      {
        all.Add(shape, number == MovingLink::kBase ? pose : motions[static_cast<std::size_t>(number)].Compose(pose));
        if (shape.form == Form::kMesh) result_.collision_meshes.push_back(shape.file);
      }
    }
    if (all.low.x() > all.high.x())
      return Error(links_.location, "it needs a <collision> with a box, a cylinder, a sphere or a mesh");
    middle_.z() = all.low.z();
    SetLinks();
    kind.form = BodyForm::kBox;
    kind.size = {2 * std::max(std::abs(all.low.x()), std::abs(all.high.x())),
                 2 * std::max(std::abs(all.low.y()), std::abs(all.high.y())), all.high.z() - all.low.z()};
    kind.description =
        "A robot of a URDF file. The position is below its root link, on the ground that it stands on at the start.";
  }

  // An upright cylinder about the middle of the axle stays a cylinder; other bodies become a box around it.
  void SetBody()
  {
    Extent all;
    const UrdfShape* round = nullptr;
    Vector3 centre = Vector3::Zero();
    std::size_t shapes = 0;
    bool has_mesh = false;
    std::vector<Vector3> corners;
    for (const UrdfLink& link : links_.links)
    {
      const bool is_wheel = link.name == wheels_.left->child || link.name == wheels_.right->child;
      for (const UrdfShape& shape : link.collision)
      {
        if (shape.form == Form::kMesh) result_.collision_meshes.push_back(shape.file);
        if (LinkNumberOf(link) != MovingLink::kBase) continue;
        all.Add(shape, InKind(link.pose));
        if (is_wheel) continue;
        has_mesh |= shape.form == Form::kMesh;
        for (const Vector3& corner : CornersOf(shape))
          corners.push_back(InKind(link.pose).Compose(shape.pose).Apply(corner));
        ++shapes;
        const Pose pose = InKind(link.pose).Compose(shape.pose);
        if (shape.form != Form::kCylinder || std::abs((pose.orientation * Vector3::UnitZ()).z()) < 1 - 1e-6 ||
            (round != nullptr && round->size.x() >= shape.size.x()))
          continue;
        round = &shape;
        centre = pose.position;
      }
    }
    if (shapes == 0)
      return Error(links_.location,
                   "it needs a <collision> with a box, a cylinder, a sphere or a mesh besides those of its wheels");
    EntityKindDescription& kind = result_.kind;
    const double x = std::max(std::abs(all.low.x()), std::abs(all.high.x()));
    const double y = std::max(std::abs(all.low.y()), std::abs(all.high.y()));
    const bool is_round = !has_mesh && round != nullptr && centre.head<2>().norm() < kSamePlace &&
                          std::max(x, y) < round->size.x() + kSamePlace;
    kind.form = is_round ? BodyForm::kCylinder : BodyForm::kBox;
    kind.size =
        is_round ? Vector3(round->size.x(), round->size.x(), all.high.z()) : Vector3(2 * x, 2 * y, all.high.z());
    if (has_mesh) SetHull(std::move(corners));
    const Vector3 filled = all.high - all.low;
    if (has_mesh)
      Note(links_.location,
           fmt::format("its shapes but the wheels collide as their convex hull in three dimensions, as "
                       "the box of {:g} x {:g} x {:g} m that holds them on planes and to sensors",
                       kind.size.x(), kind.size.y(), kind.size.z()));
    else if (!is_round && (filled.x() < 2 * x - kSamePlace || filled.y() < 2 * y - kSamePlace))
      Note(links_.location,
           fmt::format("its shapes are not about the middle of the axle; the body is the box of {:g} x "
                       "{:g} m about it that holds them",
                       2 * x, 2 * y));
    else if (!is_round && shapes > 1)
      Note(links_.location, fmt::format("its {} shapes collide as the box of {:g} x {:g} x {:g} m that holds them",
                                        shapes, kind.size.x(), kind.size.y(), kind.size.z()));
    if (all.low.z() < -kSamePlace)
      Note(links_.location,
           fmt::format("something reaches {:g} m below its wheels; the body ends at the ground", -all.low.z()));
  }

  // Sets a hull of few corners, above the ground.
  void SetHull(std::vector<Vector3> corners)
  {
    for (Vector3& corner : corners) corner.z() = std::max(corner.z(), 0.0);
    try
    {
      result_.kind.corners = HullOf(corners).corners;
    }
    catch (const std::invalid_argument& error)
    {
      Error(links_.location, fmt::format("its <collision> shapes have no convex hull: {}", error.what()));
    }
  }

  void SetMass()
  {
    for (const UrdfLink& link : links_.links) result_.kind.mass_kg += link.mass;
    if (result_.kind.mass_kg == 0) Note(links_.location, "no link has a mass; engines take that of their own for it");
  }

  // Returns the paint of a shape. The first colour of the root link is the kind's; wheels without a colour look like
  // rubber.
  MeshPart::Paint PaintOf(const UrdfShape& shape, bool is_wheel) const
  {
    using Paint = MeshPart::Paint;
    if (shape.colour && *shape.colour != result_.kind.colour) return Paint::kOwn;
    return is_wheel && !shape.colour ? Paint::kRubber : Paint::kBody;
  }

  void SetMesh()
  {
    for (const UrdfShape& shape : links_.links[links_.root].visual)
      if (shape.colour)
      {
        result_.kind.colour = *shape.colour;
        break;
      }
    for (const UrdfLink& link : links_.links)
      for (const UrdfShape& shape : link.visual)
        AddPart(shape, InKind(link.pose).Compose(shape.pose),
                wheels_.left != nullptr && (link.name == wheels_.left->child || link.name == wheels_.right->child),
                LinkNumberOf(link));
  }

  void AddPart(const UrdfShape& shape, const Pose& pose, bool is_wheel, int link)
  {
    MeshPart part;
    part.link = link;
    part.paint = PaintOf(shape, is_wheel);
    part.colour = shape.colour.value_or(part.colour);
    part.from = part.to = pose.position;
    switch (shape.form)
    {
      case Form::kSphere:
        part.form = MeshPart::Form::kBall;
        part.radius = shape.size.x();
        break;
      case Form::kCylinder:
        part.form = MeshPart::Form::kRod;
        part.radius = shape.size.x();
        part.from -= pose.orientation * Vector3(0, 0, shape.size.z() / 2);
        part.to += pose.orientation * Vector3(0, 0, shape.size.z() / 2);
        break;
      case Form::kMesh:
        part.form = MeshPart::Form::kFile;
        part.file = shape.file;
        part.scale = shape.size;
        part.orientation = pose.orientation;
        break;
      case Form::kBox:
      {
        const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
        const Vector3 half = axes.cwiseAbs() * (shape.size / 2);
        part.from -= half;
        part.to += half;
        if ((axes.cwiseAbs().rowwise().maxCoeff().array() < 1 - 1e-6).any())
          Note(shape.location, "a box that is turned is drawn as the upright one that holds it");
        break;
      }
    }
    result_.kind.mesh.push_back(part);
  }

  UrdfKind& result_;
  const UrdfLinks& links_;
  Wheels wheels_;                         // none on a robot without driven wheels
  std::vector<const UrdfJoint*> moving_;  // by link of the kind
  Vector3 middle_ = Vector3::Zero();
};

std::map<std::string, UrdfKind>& Registered()
{
  static std::map<std::string, UrdfKind> kinds;
  return kinds;
}

}  // namespace

UrdfKind KindFromUrdf(const std::string& tag, const std::string& text, const std::string& file)
{
  UrdfKind result{file, text, {}, {}, {}, {}};
  result.kind.tag = tag;
  result.kind.description = "A robot of a URDF file. The position is the middle of its axle, on the ground.";
  try
  {
    const UrdfLinks links = ReadUrdfLinks(TConfigurationTree(ReadXml(text, file)), file, result.errors, result.notes);
    if (result.errors.empty()) Builder(result, links).Build();
  }
  catch (const ConfigurationError& error)
  {
    result.errors.push_back({error.Location(), error.Message()});
  }
  return result;
}

std::vector<Diagnostic> RegisterUrdfKind(const std::string& tag, const std::string& file)
{
  UrdfKind read = KindFromUrdf(tag, ReadTextFile(file), file);
  if (!read.errors.empty()) return read.errors;
  const SourceLocation place{std::make_shared<const std::string>(file), 0, 0};
  if (const auto known = Registered().find(tag); known != Registered().end())
  {
    if (known->second.text == read.text && known->second.kind.corners == read.kind.corners)
    {
      known->second.file = file;
      return {};
    }
    return {
        {place, fmt::format("this process has read <{}> from another text before, {}; a kind stays what it is while a "
                            "process runs",
                            tag, known->second.file)}};
  }
  try
  {
    RegisterEntityKind(read.kind);
  }
  catch (const std::invalid_argument& error)
  {
    return {{place, error.what()}};
  }
  Registered().emplace(tag, std::move(read));
  return {};
}

const UrdfKind* FindUrdfKind(const std::string& tag)
{
  const auto found = Registered().find(tag);
  return found == Registered().end() ? nullptr : &found->second;
}

}  // namespace swarmanoid
