#include "launcher/worlds/imported_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "common/configuration/wording.h"
#include "common/configuration/xml_writer.h"
#include "common/experiment/mesh_files.h"
#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"
#include "common/mesh/mesh_points.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr double kOnFloor = 1e-6;  // m: positions this far below the floor are on it
constexpr std::size_t kLongestId = 60;

// Returns a number with a millionth of a millimetre, without zeros at its end.
std::string Shown(double number)
{
  const double rounded = std::round(number * 1e9) / 1e9;
  return fmt::format("{}", rounded == 0 ? 0.0 : rounded);
}

std::string Shown(const Vector3& v) { return Shown(v.x()) + ", " + Shown(v.y()) + ", " + Shown(v.z()); }

std::string ShownColour(std::uint32_t colour) { return fmt::format("#{:06x}", colour); }

using Made = std::shared_ptr<ConfigurationNode>;

Made Add(ConfigurationNode& parent, const std::string& name)
{
  auto node = std::make_shared<ConfigurationNode>();
  node->name = name;
  parent.children.push_back(node);
  return node;
}

void Set(ConfigurationNode& node, const std::string& name, const std::string& value)
{
  node.attributes.push_back({name, value, {}});
}

// Returns half the edges of the upright box around a body.
Vector3 HalfExtent(const WorldBody& body)
{
  const Eigen::Matrix3d axes = body.pose.orientation.toRotationMatrix();
  if (body.form != WorldBody::Form::kCylinder) return axes.cwiseAbs() * (body.size / 2);
  Vector3 half;
  for (int i = 0; i < 3; ++i)
    half[i] = std::abs(axes(i, 2)) * body.size.z() / 2 +
              body.size.x() * std::sqrt(std::max(0.0, 1 - axes(i, 2) * axes(i, 2)));
  return half;
}

class Writer
{
public:
  Writer(World& world, const WorldOutput& output) : world_(world), output_(output) {}

  std::string Write()
  {
    LeaveOutBelowFloor();
    FindArena();
    ConfigurationNode root;
    root.name = "ahss-config";
    const Made framework = Add(root, "framework");
    Set(*framework, "clocktick", "100");
    Set(*framework, "maxclock", "600");
    Set(*framework, "seed", "1");
    const Made arena = Add(root, "arena");
    Set(*arena, "size", Shown(size_));
    Set(*arena, "optimization", "2D");
    for (const WorldBody& body : world_.bodies) AddBody(body, *arena);
    for (const WorldLight& light : world_.lights) AddLight(light, *arena);
    const Made engine = Add(*Add(root, "engines"), "dynamics3d");
    Set(*engine, "id", "physics");
    Set(*engine, "friction", "1");
    if (world_.gravity != World().gravity) Set(*engine, "gravity", Shown(world_.gravity));
    const Made users = Add(*Add(root, "arena_physics"), "engine");
    Set(*users, "id", "physics");
    Add(*users, "all");
    std::string text = WriteXml(root);
    text.insert(text.find('\n') + 1, Comment());
    return text;
  }

private:
  // The reader of experiments refuses positions below the arena.
  void LeaveOutBelowFloor()
  {
    const auto place = [](const WorldBody& body)
    {
      const bool stands = body.form == WorldBody::Form::kCylinder;
      return body.pose.Apply(stands ? Vector3(0, 0, -body.size.z() / 2) : Vector3::Zero()).z();
    };
    std::erase_if(world_.bodies,
                  [&](const WorldBody& body)
                  {
                    if (place(body) >= -kOnFloor) return false;
                    world_.notes.push_back(
                        {body.location,
                         fmt::format("the body {} lies below the floor z = 0: it is left out", Quoted(body.name))});
                    return true;
                  });
    std::erase_if(world_.lights,
                  [&](const WorldLight& light)
                  {
                    if (light.position.z() >= -kOnFloor) return false;
                    world_.notes.push_back(
                        {light.location,
                         fmt::format("the light {} lies below the floor z = 0: it is left out", Quoted(light.name))});
                    return true;
                  });
  }

  // The arena has whole metres, so that positions of the file are easy to find in the experiment.
  void FindArena()
  {
    Eigen::AlignedBox3d box;
    for (const WorldBody& body : world_.bodies)
    {
      const Vector3 half = HalfExtent(body);
      box.extend(body.pose.position - half);
      box.extend(body.pose.position + half);
    }
    for (const WorldLight& light : world_.lights) box.extend(light.position);
    if (box.isEmpty()) box.extend(Vector3::Zero());
    const auto floor = [](double x) { return std::floor(x + kOnFloor); };
    const auto ceil = [](double x) { return std::ceil(x - kOnFloor); };
    shift_ = {-floor(box.min().x()), -floor(box.min().y()), 0};
    size_ = {ceil(box.max().x()) + shift_.x(), ceil(box.max().y()) + shift_.y(), ceil(box.max().z())};
    size_ = size_.cwiseMax(1);
  }

  std::string IdFor(const std::string& name)
  {
    std::string id;
    for (const char c : name.substr(0, kLongestId))
    {
      const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                            c == ':' || c == '-';
      id += is_plain ? c : '_';
    }
    if (id.empty() || id.front() == '.' || id.front() == ':' || id.front() == '-') id = "_" + id;
    const std::string first = id;
    std::size_t& number = used_[first];
    while (!ids_.insert(id).second) id = fmt::format("{}_{}", first.substr(0, kLongestId - 7), ++number + 1);
    return id;
  }

  void AddBody(const WorldBody& body, ConfigurationNode& arena)
  {
    const bool is_round = body.form == WorldBody::Form::kCylinder;
    const Made made = Add(arena, is_round ? "cylindric_prey" : "block");
    Set(*made, "id", IdFor(body.name));
    // A cylinder is placed by the centre of its base.
    Vector3 at = body.pose.Apply(is_round ? Vector3(0, 0, -body.size.z() / 2) : Vector3::Zero()) + shift_;
    if (at.z() < 0) at.z() = 0;
    Set(*made, "position", Shown(at));
    const EulerAngles angles = EulerFromQuaternion(body.pose.orientation.normalized());
    const Vector3 degrees(RadiansToDegrees(angles.alpha), RadiansToDegrees(angles.beta),
                          RadiansToDegrees(angles.gamma));
    if (const std::string text = Shown(degrees); text != "0, 0, 0") Set(*made, "orientation", text);
    if (is_round)
    {
      Set(*made, "radius", Shown(body.size.x()));
      Set(*made, "height", Shown(body.size.z()));
    }
    else
    {
      Set(*made, "size", Shown(body.size));
    }
    if (body.form == WorldBody::Form::kMesh)
    {
      Set(*made, "mesh", fs::path(body.mesh).lexically_proximate(output_.folder).string());
      Set(*made, "convex", "true");
    }
    Set(*made, "movable", body.movable ? "true" : "false");
    if (body.movable && body.mass_kg > 0) Set(*made, "mass", Shown(body.mass_kg));
    if (body.friction) Set(*made, "friction", Shown(*body.friction));
    if (body.restitution) Set(*made, "restitution", Shown(*body.restitution));
    if (body.colour)
      Set(*made, "colour", ShownColour(*body.colour));
    else if (is_round)
      Set(*made, "colour", "silver");
  }

  void AddLight(const WorldLight& light, ConfigurationNode& arena)
  {
    const Made made = Add(arena, "light_bulb");
    Set(*made, "id", IdFor(light.name));
    Set(*made, "position", Shown(Vector3(light.position + shift_).cwiseMax(0)));
    Set(*made, "intensity", Shown(light.intensity));
    Set(*made, "colour", ShownColour(light.colour));
  }

  std::string Comment() const
  {
    return ConvertedComment(output_.source, shift_.isZero()
                                                ? ". Positions are those of the file."
                                                : fmt::format(". Positions of the file plus {}, {}, 0 are those here.",
                                                              Shown(shift_.x()), Shown(shift_.y())));
  }

  World& world_;
  const WorldOutput& output_;
  Vector3 shift_ = Vector3::Zero();
  Vector3 size_ = Vector3::Ones();
  std::set<std::string> ids_;
  std::map<std::string, std::size_t> used_;
};

}  // namespace

void World::AddMesh(WorldBody body, const std::string& path, const Vector3& scale, const Pose& origin)
{
  const auto leave_out = [&](const std::string& why)
  {
    notes.push_back(
        {body.location, fmt::format("the mesh of {} is left out: {}: {}", Quoted(body.name), Quoted(path), why)});
  };
  if (const std::string mistake = MeshFileMistake(path); !mistake.empty()) return leave_out(mistake);
  try
  {
    std::vector<Vector3> corners = ReadMeshPoints(path).corners;
    Eigen::AlignedBox3d box;
    for (Vector3& corner : corners)
    {
      corner = corner.cwiseProduct(scale);
      box.extend(corner);
    }
    const ConvexHull hull = HullOf(corners);  // throws if the experiment could not make one
    if (body.mass_kg == 0) body.mass_kg = body.density_kg_m3 * hull.volume;
    body.form = WorldBody::Form::kMesh;
    body.mesh = path;
    body.size = box.sizes();
    body.pose = origin.Compose({box.center(), Quaternion::Identity()});
  }
  catch (const std::exception& error)
  {
    return leave_out(error.what());
  }
  notes.push_back({body.location, "a mesh collides as its convex hull: its hollows are filled"});
  bodies.push_back(std::move(body));
}

std::string ConvertedComment(const std::string& source, const std::string& about)
{
  std::string shown = source;
  // A comment must not hold two hyphens.
  for (std::size_t at = 0; (at = shown.find("--", at)) != std::string::npos;) shown.replace(at, 2, "-_");
  return fmt::format("<!-- Made from {} by `swarmanoid convert`{}\n     Add <controllers> and robots to <arena>. -->\n",
                     EscapedXml(Quoted(shown)), about);
}

std::string ExperimentOfWorld(World& world, const WorldOutput& output) { return Writer(world, output).Write(); }

}  // namespace swarmanoid
