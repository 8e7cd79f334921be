// Reads links and joints, and then computes the pose of each link by going up the joints to the root.
//
// Invariants: the links make one tree; a link with two parents, a second root or a ring is refused. In these poses all
// joints stand at zero. Meshes that collide are replaced by their hulls; meshes that are drawn stay files.
#include "common/experiment/urdf_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/experiment/mesh_files.h"
#include "common/mesh/convex_hull.h"
#include "common/mesh/mesh_points.h"

namespace swarmanoid
{
namespace
{

using Form = UrdfShape::Form;

constexpr double kMostMetres = 100;
constexpr double kHollow = 1e-3;  // m: a mesh with shallower hollows counts as convex
const char* const kNotThere =
    "it is not there; package://NAME/… is looked for in the folder NAME beside or above this file";

class Reader
{
public:
  Reader(const std::string& file, std::vector<Diagnostic>& errors, std::vector<Diagnostic>& notes)
      : file_(file), errors_(errors), notes_(notes)
  {
  }

  UrdfLinks Read(const TConfigurationTree& robot)
  {
    result_.location = robot.Location();
    if (robot.Name() != "robot")
      Error(robot, fmt::format("a URDF file begins with <robot>, not with <{}>", robot.Name()));
    for (const TConfigurationTree& child : robot.Children())
      if (child.Name() == "material") ReadMaterial(child);
    for (const TConfigurationTree& child : robot.Children())
    {
      if (child.Name().starts_with("xacro:"))
        Error(child, fmt::format("<{}> is of xacro; make a URDF file of it: xacro FILE > robot.urdf", child.Name()));
      else if (child.Name() == "link")
        ReadLink(child);
      else if (child.Name() == "joint")
        ReadJoint(child);
      else if (child.Name() != "material")
        NoEffect(child);
    }
    if (errors_.empty()) Place();
    return std::move(result_);
  }

private:
  void Error(const TConfigurationTree& at, std::string text) { errors_.push_back({at.Location(), std::move(text)}); }
  void NoEffect(const TConfigurationTree& at)
  {
    notes_.push_back({at.Location(), fmt::format("<{}> has no effect here", at.Name())});
  }

  // Returns `count` finite numbers of an attribute; `fallback` if it does not exist.
  std::vector<double> Numbers(const TConfigurationTree& of, const char* name, std::vector<double> fallback)
  {
    if (!of.Exists() || !of.HasAttribute(name)) return fallback;
    const auto numbers = ParseNumbers(of.Attribute(name));
    if (numbers && numbers->size() == fallback.size() &&
        std::ranges::all_of(*numbers, [](double number) { return std::isfinite(number) && std::abs(number) < 1e9; }))
      return *numbers;
    Error(of, fmt::format("'{}' of <{}> is '{}'; it must be {} number{}", name, of.Name(), of.Attribute(name),
                          fallback.size(), fallback.size() == 1 ? "" : "s"));
    return fallback;
  }
  Vector3 Vector(const TConfigurationTree& of, const char* name, const Vector3& fallback)
  {
    const auto numbers = Numbers(of, name, {fallback.x(), fallback.y(), fallback.z()});
    return {numbers[0], numbers[1], numbers[2]};
  }
  Pose Origin(const TConfigurationTree& of)
  {
    const TConfigurationTree origin = of.Child("origin");
    const Vector3 turned = Vector(origin, "rpy", Vector3::Zero());
    return {Vector(origin, "xyz", Vector3::Zero()), QuaternionFromEuler({turned.x(), turned.y(), turned.z()})};
  }
  double Length(const TConfigurationTree& of, const char* name)
  {
    const double length = Numbers(of, name, {0})[0];
    if (!(length > 0 && length <= kMostMetres))
      Error(of, fmt::format("<{}> needs '{}' of more than 0 and at most {} m", of.Name(), name, kMostMetres));
    return length;
  }

  static std::uint32_t Packed(const std::vector<double>& rgba)
  {
    const auto channel = [&](std::size_t k)
    { return static_cast<std::uint32_t>(std::clamp(rgba[k], 0.0, 1.0) * 255 + 0.5); };
    return channel(0) << 16 | channel(1) << 8 | channel(2);
  }

  void ReadMaterial(const TConfigurationTree& material)
  {
    if (const TConfigurationTree colour = material.Child("color"); colour.Exists())
      materials_[material.Attribute("name")] = Packed(Numbers(colour, "rgba", {0, 0, 0, 1}));
    else if (const TConfigurationTree texture = material.Child("texture"); texture.Exists())
      NoEffect(texture);
  }

  // Reads a mesh that is drawn. Returns false, with a note, if it cannot be drawn.
  bool ReadMesh(const TConfigurationTree& mesh, UrdfShape& shape)
  {
    const std::string name = mesh.Attribute("filename");
    shape.form = Form::kMesh;
    shape.size = Vector(mesh, "scale", Vector3::Ones());
    if ((shape.size.array() == 0).any())
      Error(mesh, fmt::format("the 'scale' of <mesh> is '{}'; no number may be 0", mesh.Attribute("scale")));
    shape.file = FindUrdfMesh(name, file_);
    const std::string mistake = shape.file.empty() ? kNotThere : MeshFileMistake(shape.file);
    if (!mistake.empty())
      notes_.push_back({mesh.Location(), fmt::format("the mesh {} is not drawn: {}", Quoted(name), mistake)});
    return mistake.empty();
  }

  // Reads a mesh that collides, as its hull.
  void ReadHull(const TConfigurationTree& mesh, UrdfShape& shape)
  {
    const std::string name = mesh.Attribute("filename");
    shape.form = Form::kMesh;
    shape.size = Vector(mesh, "scale", Vector3::Ones());
    shape.file = FindUrdfMesh(name, file_);
    std::string mistake = shape.file.empty() ? kNotThere : MeshFileMistake(shape.file);
    if (mistake.empty())
    {
      try
      {
        MeshPoints points = ReadMeshPoints(shape.file);
        for (Vector3& corner : points.corners) corner = corner.cwiseProduct(shape.size);
        const ConvexHull hull = HullOf(points.corners);
        shape.corners = hull.corners;
        if (const double depth = DeepestPoint(hull, points); depth > kHollow)
          notes_.push_back({mesh.Location(), fmt::format("the mesh {} is not convex: it collides as its convex hull, "
                                                         "which is up to {:.3g} m farther out",
                                                         Quoted(name), depth)});
        return;
      }
      catch (const std::exception& error)  // FileError, std::invalid_argument
      {
        mistake = error.what();
      }
    }
    Error(mesh, fmt::format("the mesh {}: {}", Quoted(name), mistake));
  }

  // Returns the depth of the deepest point in the hull (m), over the corners and the middles of the triangles.
  static double DeepestPoint(const ConvexHull& hull, const MeshPoints& points)
  {
    double depth = 0;
    for (const auto& [a, b, c] : points.triangles)
    {
      for (const std::uint32_t corner : {a, b, c}) depth = std::max(depth, hull.DepthOf(points.corners[corner]));
      depth = std::max(depth, hull.DepthOf((points.corners[a] + points.corners[b] + points.corners[c]) / 3));
    }
    return depth;
  }

  // Returns false for a geometry that is no box, cylinder or sphere.
  bool ReadGeometry(const TConfigurationTree& geometry, UrdfShape& shape)
  {
    if (const TConfigurationTree box = geometry.Child("box"); box.Exists())
    {
      shape.size = Vector(box, "size", Vector3::Zero());
      if (!(shape.size.minCoeff() > 0 && shape.size.maxCoeff() <= kMostMetres))
        Error(box, fmt::format("<box> needs a 'size' of three lengths of more than 0 and at most {} m", kMostMetres));
      return true;
    }
    if (const TConfigurationTree cylinder = geometry.Child("cylinder"); cylinder.Exists())
    {
      const double radius = Length(cylinder, "radius");
      shape.form = Form::kCylinder;
      shape.size = {radius, radius, Length(cylinder, "length")};
      return true;
    }
    if (const TConfigurationTree sphere = geometry.Child("sphere"); sphere.Exists())
    {
      shape.form = Form::kSphere;
      shape.size = Vector3::Constant(Length(sphere, "radius"));
      return true;
    }
    return false;
  }

  void ReadShape(const TConfigurationTree& element, std::vector<UrdfShape>& shapes)
  {
    UrdfShape shape;
    shape.location = element.Location();
    shape.pose = Origin(element);
    const TConfigurationTree geometry = element.Child("geometry");
    if (!geometry.Exists()) return Error(element, fmt::format("<{}> has no <geometry>", element.Name()));
    if (const TConfigurationTree mesh = geometry.Child("mesh"); mesh.Exists())
    {
      if (element.Name() == "collision")
        ReadHull(mesh, shape);
      else if (!ReadMesh(mesh, shape))
        return;
    }
    else if (!ReadGeometry(geometry, shape))
    {
      const std::vector<TConfigurationTree> children = geometry.Children();
      const TConfigurationTree& what = children.empty() ? geometry : children.front();
      const std::string text =
          fmt::format("<{}> cannot be read; boxes, cylinders, spheres and meshes can", what.Name());
      if (element.Name() == "collision") return Error(what, text);
      notes_.push_back({what.Location(), text + "; it is not drawn"});
      return;
    }
    if (const TConfigurationTree material = element.Child("material"); material.Exists())
    {
      ReadMaterial(material);
      if (const auto found = materials_.find(material.Attribute("name")); found != materials_.end())
        shape.colour = found->second;
    }
    shapes.push_back(shape);
  }

  void ReadInertial(const TConfigurationTree& inertial, UrdfLink& link)
  {
    const TConfigurationTree mass = inertial.Child("mass");
    link.mass = Numbers(mass, "value", {0})[0];
    if (link.mass < 0) Error(mass, fmt::format("a mass is {:g} kg; it must be at least 0", link.mass));
    const Pose origin = Origin(inertial);
    link.centre_of_mass = origin.position;
    const TConfigurationTree inertia = inertial.Child("inertia");
    if (!inertia.Exists()) return;
    const auto moment = [&](const char* name) { return Numbers(inertia, name, {0})[0]; };
    const double xy = moment("ixy"), xz = moment("ixz"), yz = moment("iyz");
    Eigen::Matrix3d own;
    own << moment("ixx"), xy, xz, xy, moment("iyy"), yz, xz, yz, moment("izz");
    const Eigen::Matrix3d turn = origin.orientation.toRotationMatrix();
    link.inertia = turn * own * turn.transpose();
  }

  void ReadLink(const TConfigurationTree& element)
  {
    UrdfLink link;
    link.name = element.Attribute("name");
    link.location = element.Location();
    if (link.name.empty()) Error(element, "a link needs a name");
    if (!names_.insert({link.name, result_.links.size()}).second)
      Error(element, fmt::format("the link '{}' is there twice", link.name));
    for (const TConfigurationTree& child : element.Children())
    {
      if (child.Name() == "visual")
        ReadShape(child, link.visual);
      else if (child.Name() == "collision")
        ReadShape(child, link.collision);
      else if (child.Name() == "inertial")
        ReadInertial(child, link);
      else
        NoEffect(child);
    }
    result_.links.push_back(std::move(link));
  }

  // Reads the limits and the resistance of a joint.
  void ReadMotion(const TConfigurationTree& element, UrdfJoint& joint)
  {
    if (const TConfigurationTree limit = element.Child("limit"); limit.Exists())
    {
      const auto number = [&](const char* name) -> std::optional<double>
      { return limit.HasAttribute(name) ? std::optional(Numbers(limit, name, {0})[0]) : std::nullopt; };
      joint.limit = {number("lower"), number("upper"), number("effort"), number("velocity"), limit.Location()};
    }
    if (const TConfigurationTree dynamics = element.Child("dynamics"); dynamics.Exists())
    {
      joint.damping = Numbers(dynamics, "damping", {0})[0];
      joint.friction = Numbers(dynamics, "friction", {0})[0];
      if (joint.damping < 0 || joint.friction < 0)
        Error(dynamics,
              fmt::format("the joint '{}' has a damping of {:g} and a friction of {:g}; they must be at least 0",
                          joint.name, joint.damping, joint.friction));
    }
    if (const TConfigurationTree mimic = element.Child("mimic"); mimic.Exists() && joint.type != "fixed")
      Error(mimic, fmt::format("the joint '{}' follows another one by <mimic>, which cannot be simulated; let the "
                               "controller move both",
                               joint.name));
    for (const char* without : {"calibration", "safety_controller"})
      if (const TConfigurationTree other = element.Child(without); other.Exists()) NoEffect(other);
  }

  void ReadJoint(const TConfigurationTree& element)
  {
    UrdfJoint joint;
    joint.name = element.Attribute("name");
    joint.type = element.Attribute("type");
    joint.location = element.Location();
    joint.parent = element.Child("parent").Exists() ? element.Child("parent").Attribute("link") : "";
    joint.child = element.Child("child").Exists() ? element.Child("child").Attribute("link") : "";
    joint.origin = Origin(element);
    joint.axis = Vector(element.Child("axis"), "xyz", Vector3::UnitX());
    const std::vector<std::string> types{"fixed", "continuous", "revolute", "prismatic", "floating", "planar"};
    if (std::ranges::find(types, joint.type) == types.end())
      Error(element, fmt::format("the joint '{}' is of type '{}'; the types are {}{}", joint.name, joint.type,
                                 Listed(types), DidYouMean(joint.type, types)));
    else if (joint.type == "floating" || joint.type == "planar")
      Error(element, fmt::format("the joint '{}' is of type {}, which no engine moves; revolute, continuous, prismatic "
                                 "and fixed joints can be used",
                                 joint.name, joint.type));
    if (joint.axis.norm() < 1e-6)
      Error(element, fmt::format("the joint '{}' has an axis of length 0", joint.name));
    else
      joint.axis.normalize();
    ReadMotion(element, joint);
    result_.joints.push_back(std::move(joint));
  }

  // Computes the poses of all links, from the link that is no joint's child.
  void Place()
  {
    std::map<std::string, const UrdfJoint*> above;
    for (const UrdfJoint& joint : result_.joints)
    {
      for (const std::string* link : {&joint.parent, &joint.child})
        if (!names_.contains(*link))
          errors_.push_back({joint.location,
                             fmt::format("the joint '{}' names the link '{}', which is not there", joint.name, *link)});
      if (!above.insert({joint.child, &joint}).second)
        errors_.push_back({joint.location, fmt::format("the link '{}' hangs on two joints", joint.child)});
    }
    std::vector<std::string> roots;
    for (std::size_t k = 0; k < result_.links.size(); ++k)
      if (!above.contains(result_.links[k].name))
      {
        roots.push_back(result_.links[k].name);
        result_.root = k;
      }
    if (roots.size() != 1)
      errors_.push_back({result_.location, roots.empty()
                                               ? "its links hang on each other in a ring, or there are none"
                                               : "it has several links that hang on no joint: " + Listed(roots)});
    if (!errors_.empty()) return;
    for (UrdfLink& link : result_.links)
    {
      Pose pose;
      std::size_t steps = 0;
      for (auto joint = above.find(link.name); joint != above.end(); joint = above.find(joint->second->parent))
      {
        pose = joint->second->origin.Compose(pose);
        if (++steps <= result_.joints.size()) continue;
        errors_.push_back({link.location, fmt::format("the link '{}' hangs on itself", link.name)});
        return;
      }
      link.pose = {pose.position, pose.orientation.normalized()};
    }
  }

  const std::string& file_;
  std::vector<Diagnostic>& errors_;
  std::vector<Diagnostic>& notes_;
  std::map<std::string, std::uint32_t> materials_;
  std::map<std::string, std::size_t> names_;
  UrdfLinks result_;
};

}  // namespace

const UrdfLink& UrdfLinks::LinkOf(const std::string& name) const
{
  const auto found = std::ranges::find(links, name, &UrdfLink::name);
  if (found == links.end()) throw std::out_of_range("there is no link '" + name + "'");
  return *found;
}

UrdfLinks ReadUrdfLinks(const TConfigurationTree& robot, const std::string& file, std::vector<Diagnostic>& errors,
                        std::vector<Diagnostic>& notes)
{
  return Reader(file, errors, notes).Read(robot);
}

}  // namespace swarmanoid
