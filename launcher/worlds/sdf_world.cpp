// Each link of an SDF model becomes a body, if it has one collision shape, or one body for each of them if it never
// moves. Models whose links hang together by joints are robots or mechanisms, and have no counterpart.
//
// Invariant: every element is converted, or named in a note or a mistake. Only elements that decorate, such as
// materials, and inertial properties that follow from shape and mass are skipped.
#include "launcher/worlds/sdf_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "common/configuration/wording.h"
#include "common/experiment/mesh_files.h"
#include "launcher/worlds/sdf_frames.h"
#include "launcher/worlds/world_reader.h"

namespace swarmanoid
{
namespace
{

constexpr double kSameShape = 1e-6;   // differences of poses and sizes that count as none
constexpr double kSdfGravity = -9.8;  // m/s², if the file gives none

bool IsTrue(const ConfigurationNode* child)
{
  return child != nullptr && (child->text == "true" || child->text == "1");
}

std::size_t CountOf(const ConfigurationNode& node, std::string_view name)
{
  return static_cast<std::size_t>(
      std::ranges::count_if(node.children, [&](const auto& child) { return child->name == name; }));
}

bool AreEqual(const Pose& a, const Pose& b)
{
  return (a.position - b.position).norm() < kSameShape && a.orientation.angularDistance(b.orientation) < kSameShape;
}

class SdfReader : WorldReader
{
public:
  SdfReader(World& world, const std::string& file) : WorldReader(world, true), file_(file) {}

  void Read(const ConfigurationNode& root)
  {
    world_.gravity = {0, 0, kSdfGravity};
    const ConfigurationNode* world = Child(root, "world");
    if (world == nullptr && Child(root, "model") == nullptr)
      return Mistake(root.location, "<sdf> has neither a <world> nor a <model>");
    NoteOthers(root, {"version", "world", "model"});
    for (const auto& child : root.children)
      if (child.get() != world && (child->name == "world" || (world != nullptr && child->name == "model")))
        Note(child->location, fmt::format("only the first <world> is converted: this <{}> is left out", child->name));
    if (world != nullptr) NoteOthers(*world, {"name", "gravity", "frame", "model", "light", "include"});
    const ConfigurationNode& place = world != nullptr ? *world : root;
    if (const ConfigurationNode* gravity = Child(place, "gravity"))
      SetGravity(gravity->location, Vector(gravity->location, gravity->text, "<gravity>", world_.gravity));
    SdfScope scope(place, world_);
    for (const auto& child : place.children)
    {
      if (child->name == "model") ReadModel({*child, scope.Nested(*child), scope.PoseOf(*child), "", false});
      if (child->name == "light" && world != nullptr) ReadLight(*child, scope.PoseOf(*child), "");
      if (child->name == "include") NoteInclude(*child);
    }
  }

private:
  struct Model
  {
    const ConfigurationNode& element;
    SdfScope& scope;
    Pose pose;         // in the world
    std::string name;  // the names of the models around it, with dots; then its own
    bool is_static;
    bool has_links = false;  // several
  };

  struct Shape
  {
    WorldBody body;
    std::string mesh_uri;
    Vector3 scale = Vector3::Ones();
  };

  void NoteInclude(const ConfigurationNode& include)
  {
    const ConfigurationNode* uri = Child(include, "uri");
    Note(include.location, fmt::format("<include> of {} is left out: copy the <model> of that file into this one",
                                       uri == nullptr ? "no <uri>" : Quoted(uri->text)));
  }

  void ReadModel(Model model)
  {
    const ConfigurationNode& element = model.element;
    model.name += TextOf(element, "name");
    model.is_static |= IsTrue(Child(element, "static"));
    if (!model.is_static && Child(element, "joint") != nullptr)
      return Note(
          element.location,
          fmt::format("the model {} is left out: it has joints, so it is a robot or a mechanism", Quoted(model.name)));
    NoteOthers(element, {"name", "pose", "static", "placement_frame", "canonical_link", "self_collide",
                         "allow_auto_disable", "enable_wind", "joint", "frame", "link", "model", "include"});
    model.has_links = CountOf(element, "link") > 1;
    for (const auto& child : element.children)
    {
      if (child->name == "link")
        ReadLink(*child, model);
      else if (child->name == "model")
        ReadModel({*child, model.scope.Nested(*child), model.pose.Compose(model.scope.PoseOf(*child)), model.name + ".",
                   model.is_static});
      else if (child->name == "include")
        NoteInclude(*child);
    }
  }

  void ReadLink(const ConfigurationNode& link, const Model& model)
  {
    NoteOthers(link, {"name", "pose", "inertial", "collision", "visual", "light", "kinematic", "self_collide",
                      "enable_wind", "must_be_base_link"});
    const bool is_kinematic = IsTrue(Child(link, "kinematic"));
    if (is_kinematic && !model.is_static) Note(link.location, "a <kinematic> link stands still here");
    const bool moves = !model.is_static && !is_kinematic;
    const std::string link_name = TextOf(link, "name");
    const std::string name = model.has_links ? model.name + "." + link_name : model.name;
    const auto pose_of = [&](const ConfigurationNode& child)
    { return model.pose.Compose(model.scope.PoseOf(child, link_name)); };

    std::vector<Shape> shapes;
    bool is_drawn_alone = true;
    for (const auto& child : link.children)
    {
      if (child->name == "light") ReadLight(*child, pose_of(*child), name + ".");
      if (child->name != "collision") continue;
      is_drawn_alone = false;
      if (auto shape = ReadShape(*child, pose_of(*child), true))
      {
        ReadSurface(*child, shape->body);
        shapes.push_back(std::move(*shape));
      }
    }
    if (is_drawn_alone && Child(link, "visual") != nullptr)
      return Note(link.location, fmt::format("{} is left out: it has a <visual>, but no <collision>", Quoted(name)));
    if (moves && shapes.size() > 1)
      return Note(link.location,
                  fmt::format("{} is left out: it moves and has {} collision shapes; a body has one. Keep one, or make "
                              "the model <static>",
                              Quoted(name), shapes.size()));
    std::vector<Shape> visuals;
    for (const auto& child : link.children)
      if (child->name == "visual")
        if (auto visual = ReadShape(*child, pose_of(*child), false)) visuals.push_back(std::move(*visual));
    for (std::size_t k = 0; k < shapes.size(); ++k)
    {
      Shape& shape = shapes[k];
      shape.body.name = shapes.size() > 1 ? fmt::format("{}.{}", name, shape.body.name) : name;
      shape.body.movable = moves;
      shape.body.mass_kg = moves ? MassOf(link, shape.body) : 0;
      Paint(shape, k, shapes.size(), visuals);
      AddBody(std::move(shape));
    }
  }

  double MassOf(const ConfigurationNode& link, const WorldBody& body)
  {
    const ConfigurationNode* inertial = Child(link, "inertial");
    const ConfigurationNode* mass = inertial == nullptr ? nullptr : Child(*inertial, "mass");
    if (inertial != nullptr && TextOf(*inertial, "auto") == "true")
      Note(inertial->location, fmt::format("the mass of {} is not derived from densities here: it is {} kg",
                                           Quoted(body.name), mass == nullptr ? "1" : mass->text));
    return mass == nullptr ? 1 : Mass(mass->location, Number(mass->location, mass->text, "<mass>", 1));
  }

  // Gives a body the colour of its visual, and notes that it looks different if that has another shape.
  void Paint(Shape& shape, std::size_t number, std::size_t count, const std::vector<Shape>& visuals)
  {
    if (visuals.empty()) return;
    const Shape& visual = visuals[visuals.size() == count ? number : 0];
    shape.body.colour = visual.body.colour;
    const bool is_alike = visual.body.form == shape.body.form && visual.mesh_uri == shape.mesh_uri &&
                          (visual.body.size - shape.body.size).norm() < kSameShape &&
                          (visual.scale - shape.scale).norm() < kSameShape &&
                          AreEqual(visual.body.pose, shape.body.pose);
    if (!is_alike || visuals.size() > count)
      Note(shape.body.location, "it is drawn as its <collision>: its <visual> has another shape");
  }

  // Reads the <geometry> of a <collision> or <visual>. Returns nullopt if it has no counterpart, which a note tells for
  // collisions.
  std::optional<Shape> ReadShape(const ConfigurationNode& element, const Pose& pose, bool collides)
  {
    Shape shape;
    WorldBody& body = shape.body;
    body.name = TextOf(element, "name");
    body.location = element.location;
    body.pose = pose;
    if (collides) NoteOthers(element, {"name", "pose", "geometry", "surface", "laser_retro", "max_contacts"});
    const ConfigurationNode* geometry = Child(element, "geometry");
    if (geometry == nullptr || geometry->children.empty())
    {
      if (collides) Mistake(element.location, fmt::format("<{}> has no <geometry> with a shape", element.name));
      return std::nullopt;
    }
    const ConfigurationNode& form = *geometry->children.front();
    if (form.name == "plane" && collides) ReadPlane(form, pose);
    if (form.name == "plane" || form.name == "empty") return std::nullopt;
    if (form.name == "box")
    {
      if (!ReadBox(form, body)) return std::nullopt;
    }
    else if (form.name == "cylinder")
    {
      if (!ReadCylinder(form, body)) return std::nullopt;
    }
    else if (form.name == "mesh")
    {
      if (!ReadMesh(form, shape, collides)) return std::nullopt;
    }
    else
    {
      if (collides)
        Note(form.location, fmt::format("a <{}> has no counterpart and is left out; boxes, cylinders and meshes have "
                                        "one",
                                        form.name));
      return std::nullopt;
    }
    if (!collides) body.colour = ColourOfVisual(element);
    return shape;
  }

  bool ReadBox(const ConfigurationNode& box, WorldBody& body)
  {
    const ConfigurationNode* size = Child(box, "size");
    if (size == nullptr) return Mistake(box.location, "<box> has no <size>"), false;
    body.size = Vector(size->location, size->text, "<size> of <box>", Vector3::Ones());
    return AreLengths(size->location, {body.size.data(), 3}, "<size> of <box>");
  }

  bool ReadCylinder(const ConfigurationNode& cylinder, WorldBody& body)
  {
    std::vector<double> lengths;
    for (const char* name : {"radius", "length"})
    {
      const ConfigurationNode* child = Child(cylinder, name);
      if (child == nullptr) return Mistake(cylinder.location, fmt::format("<cylinder> has no <{}>", name)), false;
      const std::string what = fmt::format("<{}> of <cylinder>", name);
      lengths.push_back(Number(child->location, child->text, what, 1));
      if (!AreLengths(child->location, {&lengths.back(), 1}, what)) return false;
    }
    body.form = WorldBody::Form::kCylinder;
    body.size = {lengths[0], lengths[0], lengths[1]};
    return true;
  }

  bool ReadMesh(const ConfigurationNode& mesh, Shape& shape, bool collides)
  {
    const ConfigurationNode* uri = Child(mesh, "uri");
    if (uri == nullptr || uri->text.empty()) return Mistake(mesh.location, "<mesh> has no <uri>"), false;
    shape.body.form = WorldBody::Form::kMesh;
    shape.mesh_uri = uri->text;
    if (collides) NoteOthers(mesh, {"uri", "scale"});
    const ConfigurationNode* scale = Child(mesh, "scale");
    if (scale == nullptr) return true;
    shape.scale = Vector(scale->location, scale->text, "<scale> of <mesh>", Vector3::Ones());
    return AreLengths(scale->location, {shape.scale.data(), 3}, "<scale> of <mesh>");
  }

  // The ground of the engine is the plane z = 0.
  void ReadPlane(const ConfigurationNode& plane, const Pose& pose)
  {
    const ConfigurationNode* normal = Child(plane, "normal");
    const Vector3 up = normal == nullptr
                           ? Vector3::UnitZ()
                           : Vector(normal->location, normal->text, "<normal> of <plane>", Vector3::UnitZ());
    const Vector3 turned = pose.orientation * up.normalized();
    if (turned.z() > 1 - kSameShape && std::abs(pose.position.z()) < kSameShape) return;
    Note(plane.location,
         fmt::format("a <plane> at the height {:g} m with the normal {:.3g}, {:.3g}, {:.3g} is left out: "
                     "the ground is the plane z = 0",
                     pose.position.z(), turned.x(), turned.y(), turned.z()));
  }

  void ReadSurface(const ConfigurationNode& collision, WorldBody& body)
  {
    const ConfigurationNode* surface = Child(collision, "surface");
    if (surface == nullptr) return;
    NoteOthers(*surface, {"friction", "bounce"});
    if (const ConfigurationNode* friction = Child(*surface, "friction"))
    {
      NoteOthers(*friction, {"ode"});
      if (const ConfigurationNode* ode = Child(*friction, "ode"))
      {
        NoteOthers(*ode, {"mu", "mu2"});
        const ConfigurationNode* mu = Child(*ode, "mu");
        const ConfigurationNode* mu2 = Child(*ode, "mu2");
        if (mu != nullptr) body.friction = Coefficient(*mu, 100);
        if (mu2 != nullptr && Coefficient(*mu2, 100) != body.friction.value_or(1))
          Note(mu2->location, "<mu2> is left out: friction is equal in all directions here, that of <mu>");
      }
    }
    if (const ConfigurationNode* bounce = Child(*surface, "bounce"))
    {
      NoteOthers(*bounce, {"restitution_coefficient"});
      if (const ConfigurationNode* coefficient = Child(*bounce, "restitution_coefficient"))
        body.restitution = Coefficient(*coefficient, 1);
    }
  }

  // Returns a coefficient from 0 to `most`. Larger ones, which files use for "very large", become `most`.
  double Coefficient(const ConfigurationNode& element, double most)
  {
    const double value = Number(element.location, element.text, fmt::format("<{}>", element.name), 0);
    if (value < 0) Mistake(element.location, fmt::format("<{}> is {:g}; it must be at least 0", element.name, value));
    return std::clamp(value, 0.0, most);
  }

  std::optional<std::uint32_t> ColourOfVisual(const ConfigurationNode& visual)
  {
    const ConfigurationNode* material = Child(visual, "material");
    if (material == nullptr) return std::nullopt;
    if (const ConfigurationNode* diffuse = Child(*material, "diffuse")) return ReadColour(*diffuse);
    const ConfigurationNode* script = Child(*material, "script");
    const ConfigurationNode* name = script == nullptr ? nullptr : Child(*script, "name");
    constexpr std::string_view kPrefix = "Gazebo/";
    if (name == nullptr || !name->text.starts_with(kPrefix)) return std::nullopt;
    std::string colour = name->text.substr(kPrefix.size());
    std::ranges::transform(colour, colour.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ParseColour(colour);
  }

  // Reads three channels, or four with opacity.
  std::uint32_t ReadColour(const ConfigurationNode& element)
  {
    const auto numbers = ParseNumbers(element.text);
    if (numbers && (numbers->size() == 3 || numbers->size() == 4)) return ColourOf(*numbers);
    Mistake(element.location, fmt::format("<{}> is {}; it must be three or four numbers from 0 to 1", element.name,
                                          Quoted(element.text)));
    return 0xffffff;
  }

  void AddBody(Shape shape)
  {
    if (shape.body.form != WorldBody::Form::kMesh) return world_.bodies.push_back(std::move(shape.body));
    const std::string path = FindSdfMesh(shape.mesh_uri);
    if (path.empty())
      return Note(shape.body.location, fmt::format("the mesh {} of {} is left out: it is not there; keep it beside the "
                                                   "file",
                                                   Quoted(shape.mesh_uri), Quoted(shape.body.name)));
    const Pose origin = shape.body.pose;
    world_.AddMesh(std::move(shape.body), path, shape.scale, origin);
  }

  // Folders of models stand above the file, beside a folder above it, or in a folder `models` there.
  std::string FindSdfMesh(const std::string& uri) const
  {
    constexpr std::string_view kModel = "model://";
    if (!uri.starts_with(kModel)) return FindUrdfMesh(uri, file_);
    const std::string inside = uri.substr(kModel.size());
    const std::string found = FindUrdfMesh("package://" + inside, file_);
    return !found.empty() ? found : FindUrdfMesh("package://models/" + inside, file_);
  }

  void ReadLight(const ConfigurationNode& light, const Pose& pose, const std::string& prefix)
  {
    const std::string type = TextOf(light, "type");
    if (type != "point")
      return Note(light.location, fmt::format("a light of type {} has no counterpart and is left out; point lights "
                                              "have one",
                                              Quoted(type)));
    NoteOthers(light, {"type", "name", "pose", "diffuse", "specular", "intensity", "cast_shadows", "visualize",
                       "direction", "light_on"});
    const ConfigurationNode* on = Child(light, "light_on");
    if (on != nullptr && !IsTrue(on)) return Note(light.location, "a light that is off is left out");
    WorldLight made;
    made.name = prefix + TextOf(light, "name");
    made.location = light.location;
    made.position = pose.position;
    if (const ConfigurationNode* diffuse = Child(light, "diffuse")) made.colour = ReadColour(*diffuse);
    if (const ConfigurationNode* intensity = Child(light, "intensity"))
      made.intensity = std::clamp(Number(intensity->location, intensity->text, "<intensity>", 1), 0.0, kMostIntensity);
    world_.lights.push_back(std::move(made));
  }

  const std::string& file_;
};

}  // namespace

World ReadSdfWorld(const ConfigurationNode& root, const std::string& file)
{
  World world;
  SdfReader(world, file).Read(root);
  return world;
}

}  // namespace swarmanoid
