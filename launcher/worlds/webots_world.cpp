// The nodes of a Webots world form a tree of frames. A Solid with a boundingObject becomes a body: one that physics
// moves if it has a Physics node. Fields, their defaults and the geometry of PROTO nodes are those of Webots R2022a and
// later (https://cyberbotics.com/doc/reference), in which z is up and the axis of a cylinder is z.
//
// Invariant: every node is converted, or named in a note or a mistake. Only fields that decorate are skipped.
#include "launcher/worlds/webots_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "common/configuration/wording.h"
#include "launcher/worlds/webots_file.h"
#include "launcher/worlds/world_reader.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr double kLevel = 1e-6;  // differences of poses that count as none
constexpr int kFirstYear = 2022;
constexpr double kWoodenBoxHeight = 0.3;  // m, without a translation in the file

class WebotsReader : WorldReader
{
public:
  WebotsReader(World& world, const std::string& file) : WorldReader(world, false), file_(file) {}

  void Read(const ConfigurationNode& root, std::string_view header)
  {
    CheckVersion(root, header);
    for (const auto& node : root.children) ReadNode(*node, {}, Around::kWorld);
  }

private:
  // The nearest Solid around a node.
  enum class Around
  {
    kWorld,  // none, or one that does not move
    kMoving
  };

  struct Shape
  {
    WorldBody body;
    std::string mesh_url;
  };

  // The header is "#VRML_SIM R2023b utf8".
  void CheckVersion(const ConfigurationNode& root, std::string_view header)
  {
    const std::vector<std::string> words = SplitWords(header);
    const std::string version = words.size() > 1 ? words[1] : std::string();
    const auto year = version.starts_with("R") ? ParseInteger(version.substr(1, 4)) : std::nullopt;
    if (!year || *year < kFirstYear)
      Mistake(root.location, fmt::format("the world is of Webots {}, in which axes have other meanings; open it with "
                                         "R2022a or later and save it",
                                         version.empty() ? "without a version" : version));
  }

  // Returns the name by which a user knows a node.
  static std::string NameOf(const ConfigurationNode& node)
  {
    std::string name = TextOf(node, "name");
    if (name.empty()) name = TextOf(node, "DEF");
    return name.empty() ? node.name : name;
  }

  Vector3 VectorOf(const ConfigurationNode& node, const char* field, const Vector3& fallback)
  {
    const ConfigurationNode::Attribute* attribute = Attribute(node, field);
    if (attribute == nullptr) return fallback;
    return Vector(attribute->location, attribute->value, fmt::format("{} of {}", field, node.name), fallback);
  }

  double NumberOf(const ConfigurationNode& node, const char* field, double fallback)
  {
    const ConfigurationNode::Attribute* attribute = Attribute(node, field);
    if (attribute == nullptr) return fallback;
    return Number(attribute->location, attribute->value, fmt::format("{} of {}", field, node.name), fallback);
  }

  // A rotation is an axis and an angle in radians.
  Pose PoseOf(const ConfigurationNode& node)
  {
    Pose pose;
    if (const ConfigurationNode::Attribute* translation = Attribute(node, "translation"))
      pose.position = Near(translation->location, VectorOf(node, "translation", Vector3::Zero()),
                           fmt::format("translation of {}", node.name));
    if (const ConfigurationNode::Attribute* rotation = Attribute(node, "rotation"))
    {
      const auto n =
          Numbers(rotation->location, rotation->value, fmt::format("rotation of {}", node.name), {0, 0, 1, 0});
      const Vector3 axis(n[0], n[1], n[2]);
      if (axis.norm() > 1e-6)
        pose.orientation = Quaternion(Eigen::AngleAxisd(n[3], axis.normalized()));
      else if (n[3] != 0)
        Mistake(rotation->location, fmt::format("rotation of {} has an axis of length 0", node.name));
    }
    if (const ConfigurationNode::Attribute* scale = Attribute(node, "scale");
        scale != nullptr && VectorOf(node, "scale", Vector3::Ones()) != Vector3::Ones())
      Mistake(scale->location,
              fmt::format("scale of {} is {}; change the sizes in it instead", node.name, Quoted(scale->value)));
    return pose;
  }

  static bool IsFrame(const ConfigurationNode& node)
  {
    return node.name == "Pose" || node.name == "Transform" || node.name == "Group";
  }

  void ReadChildren(const ConfigurationNode& node, const Pose& pose, Around around)
  {
    if (const ConfigurationNode* children = Child(node, "children"))
      for (const auto& child : children->children) ReadNode(*child, pose, around);
  }

  void LeaveOut(const ConfigurationNode& node, const std::string& why)
  {
    Note(node.location, fmt::format("{}{} is left out: {}", node.name,
                                    NameOf(node) == node.name ? std::string() : " " + Quoted(NameOf(node)), why));
  }

  // `outer`: the pose of the node's frame in the world.
  void ReadNode(const ConfigurationNode& node, const Pose& outer, Around around)
  {
    if (IsFrame(node))
    {
      NoteOthers(node, {"DEF", "name", "translation", "rotation", "scale", "children"});
      return ReadChildren(node, outer.Compose(PoseOf(node)), around);
    }
    if (node.name == "Solid") return ReadSolid(node, outer, around);
    if (node.name == "PointLight") return ReadLight(node, outer);
    if (node.name == "RectangleArena") return ReadArena(node, outer);
    if (node.name == "Floor") return NoteSlope(node, outer.Compose(PoseOf(node)));
    if (node.name == "WoodenBox") return ReadBoxProto(node, outer, Vector3::Constant(0.6), 0);
    if (node.name == "Wall") return ReadBoxProto(node, outer, {0.2, 1, 2.4}, 0.5);
    if (node.name == "WorldInfo") return ReadWorldInfo(node);
    if (node.name == "Robot") return LeaveOut(node, "it is a robot; take one of the kinds of Swarmanoid");
    if (node.name == "Shape") return LeaveOut(node, "it is in no Solid with a boundingObject, so it is only seen");
    LeaveOut(node, "it has no counterpart");
  }

  void ReadWorldInfo(const ConfigurationNode& info)
  {
    NoteOthers(info, {"DEF", "info", "title", "window", "gravity", "coordinateSystem"});
    const std::string axes = TextOf(info, "coordinateSystem");
    if (!axes.empty() && axes != "ENU")
      Mistake(Attribute(info, "coordinateSystem")->location,
              fmt::format("coordinateSystem is {}; only worlds with z up, ENU, can be read", Quoted(axes)));
    const double gravity = NumberOf(info, "gravity", 9.81);
    SetGravity(info.location, {0, 0, -gravity});
  }

  void ReadSolid(const ConfigurationNode& solid, const Pose& outer, Around around)
  {
    NoteOthers(solid, {"DEF", "name", "model", "description", "translation", "rotation", "scale", "children",
                       "boundingObject", "physics", "recognitionColors", "locked", "translationStep", "rotationStep"});
    const Pose pose = outer.Compose(PoseOf(solid));
    const ConfigurationNode* physics = FirstOf(solid, "physics");
    if (around == Around::kMoving) return LeaveOut(solid, "it is a part of a Solid that moves; a body has one shape");
    const Around inner = physics != nullptr ? Around::kMoving : Around::kWorld;
    if (const ConfigurationNode* children = Child(solid, "children"))
      for (const auto& child : children->children)
        if (child->name != "Shape" && !IsDrawing(*child)) ReadNode(*child, pose, inner);

    std::vector<Shape> shapes;
    if (const ConfigurationNode* bounding = FirstOf(solid, "boundingObject"))
    {
      const std::size_t said = world_.notes.size() + world_.mistakes.size();
      const bool has_plane = CollectShapes(*bounding, pose, shapes);
      if (shapes.empty() && !has_plane && said == world_.notes.size() + world_.mistakes.size())
        LeaveOut(solid, "its boundingObject has no shape");
    }
    else if (HasShape(solid))
    {
      return LeaveOut(solid, "it has no boundingObject, so it is only seen");
    }
    if (physics != nullptr && shapes.size() > 1)
      return LeaveOut(solid, fmt::format("it moves and its boundingObject has {} shapes; a body has one. Keep one, or "
                                         "take its physics away",
                                         shapes.size()));
    const std::optional<std::uint32_t> colour = ColourIn(solid);
    const std::string name = NameOf(solid);
    for (std::size_t k = 0; k < shapes.size(); ++k)
    {
      Shape& shape = shapes[k];
      shape.body.name = shapes.size() > 1 ? fmt::format("{}.{}", name, k) : name;
      shape.body.colour = colour;
      shape.body.movable = physics != nullptr;
      if (physics != nullptr) SetMass(*physics, shape.body);
      AddBody(std::move(shape));
    }
  }

  static const ConfigurationNode* FirstOf(const ConfigurationNode& node, std::string_view field)
  {
    const ConfigurationNode* found = Child(node, field);
    return found == nullptr || found->children.empty() ? nullptr : found->children.front().get();
  }

  // Returns whether a frame holds nothing but shapes.
  static bool IsDrawing(const ConfigurationNode& node)
  {
    if (node.name == "Shape") return true;
    if (!IsFrame(node)) return false;
    const ConfigurationNode* children = Child(node, "children");
    return children == nullptr ||
           std::ranges::all_of(children->children, [](const auto& child) { return IsDrawing(*child); });
  }

  static bool HasShape(const ConfigurationNode& node)
  {
    const ConfigurationNode* children = Child(node, "children");
    return children != nullptr &&
           std::ranges::any_of(children->children, [](const auto& child)
                               { return child->name == "Shape" || (IsFrame(*child) && HasShape(*child)); });
  }

  // Adds the shapes of a boundingObject. Returns whether a plane is among them.
  bool CollectShapes(const ConfigurationNode& node, const Pose& outer, std::vector<Shape>& shapes)
  {
    if (IsFrame(node))
    {
      const Pose pose = outer.Compose(PoseOf(node));
      bool has_plane = false;
      if (const ConfigurationNode* children = Child(node, "children"))
        for (const auto& child : children->children) has_plane |= CollectShapes(*child, pose, shapes);
      return has_plane;
    }
    if (node.name == "Shape")
    {
      const ConfigurationNode* geometry = FirstOf(node, "geometry");
      return geometry != nullptr && CollectShapes(*geometry, outer, shapes);
    }
    if (node.name == "Plane")
    {
      NoteSlope(node, outer);
      return true;
    }
    Shape shape;
    shape.body.location = node.location;
    shape.body.pose = outer;
    if (node.name == "Box")
    {
      NoteOthers(node, {"DEF", "size"});
      shape.body.size = VectorOf(node, "size", Vector3::Constant(2));
    }
    else if (node.name == "Cylinder")
    {
      NoteOthers(node, {"DEF", "radius", "height", "subdivision", "bottom", "side", "top"});
      const double radius = NumberOf(node, "radius", 1);
      shape.body.form = WorldBody::Form::kCylinder;
      shape.body.size = {radius, radius, NumberOf(node, "height", 2)};
    }
    else if (node.name == "Mesh")
    {
      NoteOthers(node, {"DEF", "url", "name", "ccw", "castShadows", "materialIndex"});
      shape.body.form = WorldBody::Form::kMesh;
      shape.mesh_url = TextOf(node, "url");
      shape.body.size = Vector3::Ones();
    }
    else
    {
      LeaveOut(node, "as a boundingObject it has no counterpart; boxes, cylinders and meshes have one");
      return false;
    }
    if (AreLengths(node.location, {shape.body.size.data(), 3}, "a " + node.name)) shapes.push_back(std::move(shape));
    return false;
  }

  // The ground of the engine is the plane z = 0.
  void NoteSlope(const ConfigurationNode& plane, const Pose& pose)
  {
    const Vector3 up = pose.orientation * Vector3::UnitZ();
    if (up.z() > 1 - kLevel && std::abs(pose.position.z()) < kLevel) return;
    LeaveOut(plane, fmt::format("it is at the height {:g} m with the normal {:.3g}, {:.3g}, {:.3g}; the ground is the "
                                "plane z = 0",
                                pose.position.z(), up.x(), up.y(), up.z()));
  }

  // A mass of -1 means the density; a density of -1 means the mass.
  void SetMass(const ConfigurationNode& physics, WorldBody& body)
  {
    NoteOthers(physics, {"DEF", "density", "mass", "centerOfMass", "inertiaMatrix"});
    const double mass = NumberOf(physics, "mass", -1);
    const double density = NumberOf(physics, "density", 1000);
    if (mass > 0)
      body.mass_kg = Mass(physics.location, mass);
    else if (!(density > 0))
      Mistake(physics.location, "Physics has neither a mass nor a density above 0");
    else if (body.form == WorldBody::Form::kMesh)
      body.density_kg_m3 = density;
    else if (body.form == WorldBody::Form::kCylinder)
      body.mass_kg = Mass(physics.location, density * std::numbers::pi * body.size.x() * body.size.x() * body.size.z());
    else
      body.mass_kg = Mass(physics.location, density * body.size.prod());
  }

  // Returns the first colour of the shapes of a node.
  std::optional<std::uint32_t> ColourIn(const ConfigurationNode& node)
  {
    const ConfigurationNode* children = Child(node, "children");
    if (children == nullptr) return std::nullopt;
    for (const auto& child : children->children)
    {
      std::optional<std::uint32_t> colour;
      if (IsFrame(*child)) colour = ColourIn(*child);
      if (child->name == "Shape") colour = ColourOfShape(*child);
      if (colour) return colour;
    }
    return std::nullopt;
  }

  std::optional<std::uint32_t> ColourOfShape(const ConfigurationNode& shape)
  {
    const ConfigurationNode* appearance = FirstOf(shape, "appearance");
    if (appearance == nullptr) return std::nullopt;
    const ConfigurationNode* material = FirstOf(*appearance, "material");
    const ConfigurationNode& holder = material != nullptr ? *material : *appearance;
    for (const char* field : {"diffuseColor", "baseColor"})
      if (Attribute(holder, field) != nullptr)
      {
        const Vector3 colour = VectorOf(holder, field, Vector3::Ones());
        return ColourOf({colour.data(), 3});
      }
    return std::nullopt;
  }

  void AddBody(Shape shape)
  {
    if (shape.body.form != WorldBody::Form::kMesh) return world_.bodies.push_back(std::move(shape.body));
    const std::string url = shape.mesh_url.substr(0, shape.mesh_url.find('\n'));
    if (url.empty() || url.find("://") != std::string::npos)
      return Note(shape.body.location, fmt::format("the mesh {} of {} is left out: keep the file beside the world",
                                                   Quoted(url), Quoted(shape.body.name)));
    const Pose origin = shape.body.pose;
    const fs::path path = fs::absolute(file_).parent_path() / url;
    world_.AddMesh(std::move(shape.body), path.lexically_normal().string(), Vector3::Ones(), origin);
  }

  void ReadLight(const ConfigurationNode& light, const Pose& outer)
  {
    NoteOthers(light, {"DEF", "location", "color", "intensity", "on", "castShadows", "radius", "ambientIntensity"});
    if (TextOf(light, "on") == "FALSE") return LeaveOut(light, "it is off");
    WorldLight made;
    made.name = NameOf(light) == light.name ? "light" : NameOf(light);
    made.location = light.location;
    made.position =
        outer.Apply(Near(light.location, VectorOf(light, "location", Vector3::Zero()), "location of PointLight"));
    made.intensity = std::clamp(NumberOf(light, "intensity", 1), 0.0, kMostIntensity);
    const Vector3 colour = VectorOf(light, "color", Vector3::Ones());
    made.colour = ColourOf({colour.data(), 3});
    world_.lights.push_back(std::move(made));
  }

  // A WoodenBox is placed by its centre, a Wall by its base: `lift` is the part of the height between the two.
  void ReadBoxProto(const ConfigurationNode& node, const Pose& outer, const Vector3& usual_size, double lift)
  {
    NoteOthers(node, {"DEF", "name", "translation", "rotation", "size", "mass", "locked", "appearance"});
    WorldBody body;
    body.name = NameOf(node);
    body.location = node.location;
    body.size = VectorOf(node, "size", usual_size);
    if (!AreLengths(node.location, {body.size.data(), 3}, "size of " + node.name)) return;
    Pose pose = PoseOf(node);
    if (Attribute(node, "translation") == nullptr && node.name == "WoodenBox") pose.position.z() = kWoodenBoxHeight;
    body.pose = outer.Compose(pose).Compose({{0, 0, lift * body.size.z()}, Quaternion::Identity()});
    const double mass = NumberOf(node, "mass", 0);
    body.movable = mass > 0;
    if (body.movable) body.mass_kg = Mass(node.location, mass);
    world_.bodies.push_back(std::move(body));
  }

  // The walls of a RectangleArena stand around its floor; those along x include the corners.
  void ReadArena(const ConfigurationNode& arena, const Pose& outer)
  {
    NoteOthers(arena, {"DEF", "name", "translation", "rotation", "floorSize", "floorTileSize", "floorAppearance",
                       "wallThickness", "wallHeight", "wallAppearance"});
    const Pose pose = outer.Compose(PoseOf(arena));
    NoteSlope(arena, pose);
    std::vector<double> floor{1, 1};
    if (const ConfigurationNode::Attribute* size = Attribute(arena, "floorSize"))
      floor = Numbers(size->location, size->value, "floorSize of RectangleArena", floor);
    const double thickness = NumberOf(arena, "wallThickness", 0.01);
    const double height = NumberOf(arena, "wallHeight", 0.1);
    if (!AreLengths(arena.location, std::vector<double>{floor[0], floor[1], thickness, height}, "a RectangleArena"))
      return;
    const auto add = [&](const char* side, const Vector3& at, const Vector3& size)
    {
      WorldBody wall;
      wall.name = fmt::format("{}.{}", NameOf(arena), side);
      wall.location = arena.location;
      wall.pose = pose.Compose({at, Quaternion::Identity()});
      wall.size = size;
      world_.bodies.push_back(std::move(wall));
    };
    const double x = (floor[0] + thickness) / 2;
    const double y = (floor[1] + thickness) / 2;
    const Vector3 along_y(thickness, floor[1], height);
    const Vector3 along_x(floor[0] + 2 * thickness, thickness, height);
    add("east", {x, 0, height / 2}, along_y);
    add("west", {-x, 0, height / 2}, along_y);
    add("north", {0, y, height / 2}, along_x);
    add("south", {0, -y, height / 2}, along_x);
  }

  const std::string& file_;
};

}  // namespace

World ReadWebotsWorld(std::string_view text, const std::string& file)
{
  World world;
  const auto root = ReadWebotsFile(text, file);
  WebotsReader(world, file).Read(*root, text.substr(0, text.find('\n')));
  return world;
}

}  // namespace swarmanoid
