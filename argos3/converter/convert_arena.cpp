#include "argos3/converter/convert_arena.h"

#include <algorithm>
#include <filesystem>

#include "common/configuration/wording.h"
#include "common/math/pose.h"

namespace swarmanoid::argos3
{

namespace fs = std::filesystem;

ArenaConverter::ArenaConverter(const ConfigurationNode& arena, ConvertedExperiment& result)
    : NodeReader(result), arena_(arena)
{
  ReadFloor(FindChild(arena, "floor"));
  FindArena();
  FindBearers(arena);
}

void ArenaConverter::ReadFloor(const ConfigurationNode* floor)
{
  if (floor == nullptr) return;
  const std::string source = NeededText(*floor, "source");
  if (source == "loop_functions")
    floor_id_ = NeededText(*floor, "id");
  else if (source != "image")
    Mistake(floor->location,
            "a floor of source " + Quoted(source) + " has no counterpart; take an image, or loop_functions");
}

std::string ArenaConverter::PictureOf(const ConfigurationNode& floor)
{
  const std::string path = NeededText(floor, "path");
  const fs::path here = fs::current_path() / path;
  std::error_code none;
  return fs::is_regular_file(here, none) ? here.lexically_normal().string() : path;
}

void ArenaConverter::ConvertFloor(const ConfigurationNode& theirs, ConfigurationNode& parent)
{
  if (Text(theirs, "source").value_or("") != "image") return;
  const SourceLocation& at = theirs.location;
  const Vector3 size = NeededVector(arena_, "size");
  Vector3 middle = Vector(arena_, "center") + origin_;
  middle.z() = 0;
  const Made made = AddNode(parent, "ground_patch", at);
  SetValue(*made, "id", NeededText(theirs, "id"), at);
  SetValue(*made, "picture", PictureOf(theirs), at);
  SetValue(*made, "size", fmt::format("{}, {}", size.x(), size.y()), at);
  SetValue(*made, "position", TextOf(middle), at);
  NoteOthers(theirs, {"id", "source", "path"});
}

void ArenaConverter::FindArena()
{
  const Vector3 size = NeededVector(arena_, "size");
  if (const auto* attribute = FindAttributeOf(arena_, "size");
      attribute != nullptr && ParseVector(attribute->value) && !(size.x() > 0 && size.y() > 0 && size.z() >= 0))
    Mistake(attribute->location, "'size' of <arena> is " + Quoted(attribute->value) +
                                     "; it must be above 0 m along x and y, and from 0 m on along z");
  const Vector3 center = Vector(arena_, "center");
  low_ = center - size / 2;
  high_ = center + size / 2;
  low_.z() = 0;
  for (const auto& child : arena_.children)
  {
    if (child->name == "distribute") HoldDistributed(*child);
    const ConfigurationNode* body = FindChild(*child, "body");
    const ConfigurationNode& placed = body != nullptr ? *body : *child;
    if (FindAttributeOf(placed, "position") == nullptr) continue;
    const Vector3 at = Vector(placed, "position");
    low_ = low_.cwiseMin(at);
    high_ = high_.cwiseMax(at);
    if (child->name == "box") high_.z() = std::max(high_.z(), at.z() + Vector(*child, "size").z());
  }
  // An arena of height 0 is a plane on which robots stand.
  if (high_.z() <= low_.z()) high_.z() = low_.z() + 1;
  origin_ = -low_;
}

void ArenaConverter::HoldDistributed(const ConfigurationNode& distribute)
{
  const ConfigurationNode* position = FindChild(distribute, "position");
  if (position == nullptr) return;
  for (const char* corner : {"min", "max", "values"})
  {
    if (FindAttributeOf(*position, corner) == nullptr) continue;
    low_ = low_.cwiseMin(Vector(*position, corner));
    high_ = high_.cwiseMax(Vector(*position, corner));
  }
}

void ArenaConverter::FindBearers(const ConfigurationNode& within)
{
  for (const auto& child : within.children)
  {
    if (child->name == "distribute" || child->name == "entity") FindBearers(*child);
    const std::string kind = KindOf(child->name);
    const ConfigurationNode* controller = FindChild(*child, "controller");
    if (kind.empty() || controller == nullptr) continue;
    Bearers& bearers = bearers_[NeededText(*controller, "config")];
    bearers.kinds.insert(kind);
    if (kind == "footbot") bearers.camera_aperture = Positive(*child, "omnidirectional_camera_aperture", 70);
    const bool is_epuck = kind == "argos3_epuck";
    bearers.perspective_aperture = Positive(*child, "perspective_camera_aperture", 30);
    bearers.perspective_range = Positive(*child, "perspective_camera_range", 2);
    bearers.battery = FindChild(*child, "battery");
    bearers.radio_range = Positive(*child, "rab_range", is_epuck ? 0.8 : 3);
    bearers.radio_bytes = Whole(*child, "rab_data_size", is_epuck ? 2 : 10);
    if (bearers.radio_bytes < 1 || bearers.radio_bytes > 10'000)
      Mistake(child->location, "'rab_data_size' is " + std::to_string(bearers.radio_bytes) +
                                   "; range-and-bearing messages have 1 to 10000 bytes here");
  }
}

std::string ArenaConverter::KindOf(const std::string& tag)
{
  return tag == "foot-bot" ? "footbot" : tag == "eye-bot" ? "eyebot" : tag == "e-puck" ? "argos3_epuck" : "";
}

void ArenaConverter::Convert(ConfigurationNode& ours)
{
  const SourceLocation& at = arena_.location;
  const Made made = AddNode(ours, "arena", at);
  SetValue(*made, "size", TextOf(Vector3(high_ - low_)), at);
  NoteOthers(arena_, {"size", "center", "positional_index", "positional_grid_size"});
  for (const auto& child : arena_.children)
    if (child->name == "distribute")
      ConvertDistribute(*child, *made);
    else if (child->name == "floor")
      ConvertFloor(*child, *made);
    else
      ConvertEntity(*child, NeededText(*child, "id"), *made, true);
  AddSpares(*made);
  SetValue(*made, "optimization", kinds_.contains("eyebot") ? "3D" : "2D", at);
}

void ArenaConverter::ConvertEntity(const ConfigurationNode& theirs, const std::string& id, ConfigurationNode& parent,
                                   bool placed)
{
  const SourceLocation& at = theirs.location;
  const std::string robot = KindOf(theirs.name);
  Made made;
  double lift = 0;
  if (!robot.empty())
  {
    made = AddNode(parent, robot, at);
    if (const ConfigurationNode* controller = FindChild(theirs, "controller"))
      SetValue(*made, "controller", NeededText(*controller, "config"), controller->location);
    // The focal length determines none of the angles of the image.
    NoteOthers(theirs,
               {"id", "omnidirectional_camera_aperture", "perspective_camera_aperture", "perspective_camera_range",
                "perspective_camera_focal_length", "perspective_camera_front", "rab_range", "rab_data_size"});
    if (!Flag(theirs, "perspective_camera_front", true))
      Mistake(at, "a perspective camera that looks up has no counterpart; leave 'perspective_camera_front' out");
  }
  else if (theirs.name == "box")
  {
    const ConfigurationNode* leds = FindChild(theirs, "leds");
    made = AddNode(parent, leds == nullptr ? "block" : kLitBox, at);
    if (leds != nullptr) SetValue(*made, "colour", ColourOfLeds(*leds), at);
    const Vector3 size = NeededVector(theirs, "size");
    lift = size.z() / 2;
    SetValue(*made, "size", TextOf(size), at);
    SetMovable(theirs, *made);
    NoteOthers(theirs, {"id", "size", "movable", "mass"});
  }
  else if (theirs.name == "cylinder")
  {
    made = AddNode(parent, "cylindric_prey", at);
    SetValue(*made, "radius", NeededText(theirs, "radius"), at);
    SetValue(*made, "height", NeededText(theirs, "height"), at);
    // Cameras of ARGoS3 see LEDs and lights, not bodies.
    const ConfigurationNode* leds = FindChild(theirs, "leds");
    SetValue(*made, "colour", leds == nullptr ? "black" : ColourOfLeds(*leds), at);
    SetMovable(theirs, *made);
    NoteOthers(theirs, {"id", "radius", "height", "movable", "mass"});
  }
  else if (theirs.name == "light")
  {
    made = AddNode(parent, "light_bulb", at);
    SetValue(*made, "intensity", Text(theirs, "intensity").value_or("1"), at);
    SetValue(*made, "colour", Text(theirs, "color").value_or("yellow"), at);
    NoteOthers(theirs, {"id", "position", "orientation", "color", "intensity", "medium"});
  }
  else
  {
    Mistake(at, "<" + theirs.name +
                    "> has no counterpart; those that have: foot-bot, eye-bot, e-puck, box, cylinder, light, floor, "
                    "distribute");
    return;
  }
  kinds_.insert(made->name);
  SetValue(*made, "id", id, at);
  if (FindChild(theirs, "leds") != nullptr && theirs.name != "cylinder" && theirs.name != "box")
    Mistake(FindChild(theirs, "leds")->location, "LEDs on <" + theirs.name + "> have no counterpart; leave them out");
  if (placed) SetPlace(theirs, *made, lift);
}

std::string ArenaConverter::ColourOfLeds(const ConfigurationNode& leds)
{
  std::string first;
  for (const auto& led : leds.children)
  {
    const std::string colour = Text(*led, "color").value_or("black");
    if (first.empty()) first = colour;
    if (colour != first) Note(led->location, "all LEDs of one object have the colour of the first one here");
  }
  if (first.empty()) return "black";
  const auto channels = ParseNumbers(first);
  if (!channels) return first;
  if (channels->size() < 3)
    Mistake(leds.location, "'" + first + "' is no colour; write a name, or red,green,blue from 0 to 255");
  std::string text = "#";
  for (std::size_t i = 0; i < std::min<std::size_t>(channels->size(), 3); ++i)
    text += fmt::format("{:02x}", static_cast<int>(std::clamp((*channels)[i], 0.0, 255.0)));
  return text;
}

void ArenaConverter::KeepSpare(const std::string& controller, const std::string& kind, int quantity)
{
  bearers_[controller].kinds.insert(kind);
  spares_[controller] = {kind, quantity};
}

// Twice as many bodies as in the rehearsal are kept, so that functions may make more in steps, or with another seed.
void ArenaConverter::AddMadeBodies(ConfigurationNode& parent)
{
  constexpr int kFurther = 20;  // at least so many
  int number = 0;
  for (const auto& [shape, count] : made_bodies_)
  {
    const SourceLocation& at = arena_.location;
    const Made reserve = AddNode(parent, "reserve", at);
    SetValue(*reserve, "quantity", std::to_string(count + std::max(count, kFurther)), at);
    const Made body = AddNode(*reserve, shape.tag, at);
    SetValue(*body, "id", kMadeBody + std::to_string(++number), at);
    if (shape.tag == kLitBox)
      SetValue(*body, "size", TextOf(shape.size), at);
    else
    {
      SetValue(*body, "radius", TextOf(shape.size.x()), at);
      SetValue(*body, "height", TextOf(shape.size.z()), at);
    }
    SetValue(*body, "colour", "black", at);
    // A waiting body must be movable. One that should not move gets a mass that no robot can push.
    SetValue(*body, "movable", "true", at);
    SetValue(*body, "mass", TextOf(shape.movable ? shape.mass_kg : kUnmovableKg), at);
    kinds_.insert(shape.tag);
  }
}

void ArenaConverter::AddSpares(ConfigurationNode& parent)
{
  AddMadeBodies(parent);
  if (spare_lights_ > 0)
  {
    const Made reserve = AddNode(parent, "reserve", arena_.location);
    SetValue(*reserve, "quantity", std::to_string(spare_lights_), arena_.location);
    SetValue(*AddNode(*reserve, "light_bulb", arena_.location), "id", "made_light", arena_.location);
  }
  for (const auto& [controller, spare] : spares_)
  {
    const Made reserve = AddNode(parent, "reserve", arena_.location);
    SetValue(*reserve, "quantity", std::to_string(spare.second), arena_.location);
    const Made robot = AddNode(*reserve, spare.first, arena_.location);
    SetValue(*robot, "id", SpareOf(controller), arena_.location);
    SetValue(*robot, "controller", controller, arena_.location);
    kinds_.insert(spare.first);
  }
}

void ArenaConverter::SetMovable(const ConfigurationNode& theirs, ConfigurationNode& made)
{
  NeededText(theirs, "movable");
  const bool movable = Flag(theirs, "movable", false);
  SetValue(made, "movable", movable ? "true" : "false", theirs.location);
  if (!movable) return;
  const double mass_kg = Number(theirs, "mass", 1);
  if (mass_kg > kHeaviestKg)
    Note(theirs.location, "a mass of " + TextOf(mass_kg) + " kg is " + TextOf(kHeaviestKg) + " kg here");
  SetValue(made, "mass", TextOf(std::min(mass_kg, kHeaviestKg)), theirs.location);
}

void ArenaConverter::SetPlace(const ConfigurationNode& theirs, ConfigurationNode& made, double lift)
{
  const bool is_light = theirs.name == "light";
  const ConfigurationNode* body = is_light ? &theirs : Needed(theirs, "body");
  if (body == nullptr) return;
  const Vector3 zyx = Vector(*body, "orientation");
  const Quaternion orientation = Quaternion(Eigen::AngleAxisd(zyx.z() * kRadians, Vector3::UnitX())) *
                                 Eigen::AngleAxisd(zyx.y() * kRadians, Vector3::UnitY()) *
                                 Eigen::AngleAxisd(zyx.x() * kRadians, Vector3::UnitZ());
  const Vector3 position = NeededVector(*body, "position") + origin_ + orientation * Vector3(0, 0, lift);
  SetValue(made, "position", TextOf(position), body->location);
  // The three angles are converted to fixed axes; a plain heading stays as it is.
  const EulerAngles fixed = EulerFromQuaternion(orientation);
  const Vector3 xyz = zyx.y() == 0 && zyx.z() == 0 ? Vector3(0, 0, zyx.x())
                                                   : Vector3(Vector3(fixed.alpha, fixed.beta, fixed.gamma) / kRadians);
  if (!is_light) SetValue(made, "orientation", TextOf(xyz), body->location);
}

void ArenaConverter::ConvertDistribute(const ConfigurationNode& theirs, ConfigurationNode& parent)
{
  const SourceLocation& at = theirs.location;
  const ConfigurationNode* position = Needed(theirs, "position");
  const ConfigurationNode* orientation = Needed(theirs, "orientation");
  const ConfigurationNode* entity = Needed(theirs, "entity");
  if (position == nullptr || orientation == nullptr || entity == nullptr) return;
  if (Whole(*entity, "quantity", 1) == 0) return;
  const Made made = AddNode(parent, "distribute", at);
  SetValue(*made, "quantity", NeededText(*entity, "quantity"), entity->location);
  SetValue(*made, "max_trials", NeededText(*entity, "max_trials"), entity->location);
  const Made positions = AddNode(*made, "position", position->location);
  ConvertOrientations(*orientation, *AddNode(*made, "orientation", orientation->location));
  if (entity->children.size() != 1) return Mistake(entity->location, "<entity> holds one element: what is distributed");
  const ConfigurationNode& what = *entity->children.front();
  // Our position is the middle of a box; in ARGoS3 it is the middle of the base.
  ConvertPositions(*position, *positions, what.name == "box" ? NeededVector(what, "size").z() / 2 : 0);
  const std::string id = NeededText(what, "id");
  const long long first = Whole(*entity, "base_num", 0);
  if (first < 0)
    Mistake(entity->location, "'base_num' is " + std::to_string(first) + "; entities are numbered from 0 on");
  const std::string ours = OurIdOfDistributed(what, first);
  distributed_ += (distributed_.empty() ? "" : " ") + id + ":" + std::to_string(first) + ":" + ours;
  ConvertEntity(what, ours, *made, false);
}

std::string ArenaConverter::OurIdOfDistributed(const ConfigurationNode& what, long long first)
{
  std::string id = Text(what, "id").value_or("");
  if (id.empty()) id = KindOf(what.name).empty() ? what.name : KindOf(what.name);
  if (!distributed_ids_.insert(id).second && first != 0) id += "." + std::to_string(first);
  distributed_ids_.insert(id);
  return id;
}

void ArenaConverter::ConvertPositions(const ConfigurationNode& theirs, ConfigurationNode& made, double lift)
{
  const std::string method = NeededText(theirs, "method");
  const auto shifted = [&](const char* from, const char* to)
  { SetValue(made, to, TextOf(Vector3(NeededVector(theirs, from) + origin_ + Vector3(0, 0, lift))), theirs.location); };
  const auto same = [&](const char* from, const char* to)
  { SetValue(made, to, TextOf(NeededVector(theirs, from)), theirs.location); };
  SetValue(made, "method", method == "constant" ? "uniform" : method, theirs.location);
  if (method == "uniform")
  {
    shifted("min", "min");
    shifted("max", "max");
  }
  else if (method == "gaussian")
  {
    shifted("mean", "mean");
    same("std_dev", "deviation");
  }
  else if (method == "constant")
  {
    shifted("values", "min");
    shifted("values", "max");
  }
  else if (method == "grid")
  {
    shifted("center", "centre");
    same("distances", "spacing");
    same("layout", "layout");
  }
  else
    Mistake(theirs.location, Quoted(method) + " is no method; uniform, gaussian, constant and grid are");
}

void ArenaConverter::ConvertOrientations(const ConfigurationNode& theirs, ConfigurationNode& made)
{
  const std::string method = NeededText(theirs, "method");
  const auto turned = [&](const char* from, const char* to)
  {
    const Vector3 zyx = NeededVector(theirs, from);
    if (zyx.y() != 0 || zyx.z() != 0)
      Mistake(theirs.location, std::string("'") + from + "' tilts what it distributes, which has no counterpart; " +
                                   "leave y and x at 0");
    SetValue(made, to, TextOf(Vector3(0, 0, zyx.x())), theirs.location);
  };
  SetValue(made, "method", method, theirs.location);
  if (method == "uniform")
  {
    turned("min", "min");
    turned("max", "max");
  }
  else if (method == "gaussian")
  {
    turned("mean", "mean");
    turned("std_dev", "deviation");
  }
  else if (method == "constant")
    turned("values", "value");
  else
    Mistake(theirs.location, Quoted(method) + " is no method; uniform, gaussian and constant are");
}

}  // namespace swarmanoid::argos3
