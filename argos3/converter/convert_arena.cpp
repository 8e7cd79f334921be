// ARGoS3's arena lies around a centre of any coordinates, ours begins at 0. The arena here is the smallest one that
// holds ARGoS3's arena and the position of every entity, since some files place entities outside of theirs. Its lowest
// corner becomes our origin: all positions are shifted by the same vector, and the plug-in shifts the positions that
// controllers and loop functions see back again.
//
// Boxes are placed by the middle of their base there and by their middle here, so they are lifted by half their height.
// Entities that loop functions may create while the run goes on wait as a reserve.
#include "argos3/converter/convert_arena.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "argos3/converter/our_ids.h"
#include "argos3/converter/robot_rows.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_writer.h"
#include "common/math/pose.h"

namespace swarmanoid::argos3
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* kTiltLost =
    "dynamics2d keeps the heading alone, and pointmass3d that of robots: the tilt has no effect, as in ARGoS3";

}  // namespace

ArenaConverter::ArenaConverter(const ConfigurationNode& arena, const ConfigurationNode* controllers,
                               ConvertedExperiment& result)
    : NodeReader(result), arena_(arena)
{
  if (controllers != nullptr)
    for (const auto& controller : controllers->children)
      if (const auto* id = FindAttributeOf(*controller, "id"))
      {
        controllers_.insert(OurCharacters(id->value));
        FindDemiurgeEPucks(OurCharacters(id->value), *controller);
      }
  ReadFloor(FindChild(arena, "floor"));
  FindArena();
  FindBearers(arena);
}

void ArenaConverter::FindDemiurgeEPucks(const std::string& id, const ConfigurationNode& controller)
{
  for (const char* list : {"sensors", "actuators"})
    if (const ConfigurationNode* devices = FindChild(controller, list))
      for (const auto& device : devices->children)
        if (const RobotRow* owner = OwnerOfDevice(device->name); owner != nullptr && owner->kind == kDemiurgeEPuck)
          demiurge_epucks_.emplace(id, owner->radio_range_m);
  const ConfigurationNode* actuators = FindChild(controller, "actuators");
  const ConfigurationNode* sender = actuators == nullptr ? nullptr : FindChild(*actuators, "epuck_range_and_bearing");
  if (sender != nullptr && FindAttributeOf(*sender, "range") != nullptr)
    demiurge_epucks_[id] = Positive(*sender, "range", 0.8);
}

std::string ArenaConverter::KindOfRobot(const ConfigurationNode& robot)
{
  std::string kind = KindOf(robot.name);
  const ConfigurationNode* controller = FindChild(robot, "controller");
  if (kind != "argos3_epuck" || controller == nullptr) return kind;
  const auto* id = FindAttributeOf(*controller, "config");
  if (id != nullptr && demiurge_epucks_.contains(OurCharacters(id->value))) kind = kDemiurgeEPuck;
  return kind;
}

void ArenaConverter::ReadFloor(const ConfigurationNode* floor)
{
  if (floor == nullptr) return;
  const std::string source = NeededText(*floor, "source");
  if (source == "loop_functions")
  {
    floor_id_ = NeededText(*floor, "id");
    NoteOthers(*floor, {"id", "source"});
  }
  else if (source != "image")
    Mistake(floor->location,
            "a floor of source " + Quoted(source) + " has no counterpart; take an image, or loop_functions");
}

void ArenaConverter::PaintFloorWhite()
{
  if (floor_id_.empty()) return;
  Note(FindChild(arena_, "floor")->location, "without <loop_functions> the floor is white");
  floor_id_.clear();
}

// Returns a text with the values of environment variables, such as $HOME, in their places.
std::string ArenaConverter::Expanded(std::string text, const ConfigurationNode::Attribute* attribute)
{
  constexpr const char* kOfNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  for (std::size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at))
  {
    const std::size_t end = std::min(text.find_first_not_of(kOfNames, at + 1), text.size());
    const std::string name = text.substr(at + 1, end - at - 1);
    const char* value = name.empty() ? nullptr : std::getenv(name.c_str());
    if (value == nullptr)
    {
      Mistake(attribute->location, "the environment has no variable " + Quoted(name) + "; set it, or write its value");
      return text;
    }
    text.replace(at, end - at, value);
    at += std::string_view(value).size();
  }
  return text;
}

std::string ArenaConverter::PictureOf(const ConfigurationNode& floor)
{
  const std::string path = Expanded(NeededText(floor, "path"), FindAttributeOf(floor, "path"));
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
  SetValue(*made, "id", OurIdOf(theirs), at);
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
    const std::string kind = KindOfRobot(*child);
    const ConfigurationNode* controller = FindChild(*child, "controller");
    if (kind.empty() && controller != nullptr)
      unknown_controllers_.insert(OurCharacters(Text(*controller, "config").value_or("")));
    if (kind.empty() || controller == nullptr) continue;
    const std::string id = OurCharacters(NeededText(*controller, "config"));
    const Bearers bearers = BearersOf(*child, kind, *controller);
    largest_radio_range_ = std::max(largest_radio_range_, bearers.radio_range);
    const auto text = [](const ConfigurationNode* node) { return node == nullptr ? "" : WriteXml(*node); };
    const std::string properties =
        fmt::format("{} {} {} {} {} {} {} {}", kind, bearers.camera_aperture, bearers.perspective_aperture,
                    bearers.perspective_range, bearers.radio_range, bearers.radio_bytes, text(bearers.battery),
                    text(bearers.params));
    std::string& ours = variant_ids_[{id, properties}];
    if (ours.empty())
    {
      std::vector<Variant>& variants = variants_[id];
      ours = id;
      for (std::size_t number = variants.size() + 1; number > 1 && controllers_.contains(ours); ++number)
        ours = fmt::format("{}.{}", id, number);
      controllers_.insert(ours);
      variants.push_back({ours, bearers});
    }
    controller_of_robot_[child.get()] = ours;
  }
}

Bearers ArenaConverter::BearersOf(const ConfigurationNode& robot, const std::string& kind,
                                  const ConfigurationNode& controller)
{
  const RobotRow& row = *RobotOfKind(kind);
  Bearers bearers;
  bearers.kinds.insert(kind);
  if (kind == "footbot" || kind == kDemiurgeEPuck)
    bearers.camera_aperture = Positive(robot, "omnidirectional_camera_aperture", 70);
  if (!row.is_generic || row.flies)
  {
    const std::string camera = kind == "footbot" ? "perspective_camera_" : "camera_";
    bearers.perspective_aperture = Positive(robot, camera + "aperture", 30);
    bearers.perspective_range = Positive(robot, camera + "range", row.is_generic ? 10 : 2);
  }
  bearers.battery = FindChild(robot, "battery");
  bearers.params = FindChild(controller, "params");
  if (kind == kDemiurgeEPuck)
    bearers.radio_range = demiurge_epucks_.at(OurCharacters(NeededText(controller, "config")));
  else
    bearers.radio_range = row.radio_range_name.empty()
                              ? row.radio_range_m
                              : Positive(robot, std::string(row.radio_range_name), row.radio_range_m);
  bearers.radio_bytes = row.has_own_messages ? row.radio_bytes : Whole(robot, "rab_data_size", row.radio_bytes);
  if (bearers.radio_bytes < 1 || bearers.radio_bytes > 10'000)
    Mistake(robot.location, "'rab_data_size' is " + std::to_string(bearers.radio_bytes) +
                                "; range-and-bearing messages have 1 to 10000 bytes here");
  return bearers;
}

const std::vector<ArenaConverter::Variant>& ArenaConverter::VariantsOf(const std::string& controller)
{
  std::vector<Variant>& variants = variants_[controller];
  if (variants.empty()) variants.push_back({controller, {}});
  return variants;
}

std::string ArenaConverter::KindOf(const std::string& tag)
{
  const RobotRow* row = RobotOfTag(tag);
  return row == nullptr ? "" : std::string(row->kind);
}

void ArenaConverter::Convert(ConfigurationNode& ours)
{
  const SourceLocation& at = arena_.location;
  const Made made = AddNode(ours, "arena", at);
  SetValue(*made, "size", TextOf(Vector3(high_ - low_)), at);
  NoteOthers(arena_, {"size", "center"});
  for (const auto& child : arena_.children)
    if (child->name != "distribute")
      if (const auto id = Text(*child, "id")) single_ids_.insert(*id);
  for (const auto& child : arena_.children)
    if (child->name == "distribute")
      ConvertDistribute(*child, *made);
    else if (child->name == "floor")
      ConvertFloor(*child, *made);
    else
      ConvertEntity(*child, OurIdOf(*child), *made, true);
  AddTranslations();
  AddSpares(*made);
  SetValue(*made, "optimization", std::ranges::any_of(kinds_, Flies) ? "3D" : "2D", at);
}

void ArenaConverter::ConvertEntity(const ConfigurationNode& theirs, const std::string& id, ConfigurationNode& parent,
                                   bool placed)
{
  const SourceLocation& at = theirs.location;
  const std::string robot = KindOfRobot(theirs);
  Made made;
  double lift = 0;
  if (!robot.empty())
  {
    made = AddNode(parent, robot, at);
    NoteOtherChildren(theirs, {"body", "controller", "battery"});
    if (const ConfigurationNode* controller = FindChild(theirs, "controller"))
    {
      NoteOthers(*controller, {"config"});
      NoteOtherChildren(*controller, {"params"});
      SetValue(*made, "controller", controller_of_robot_.at(&theirs), controller->location);
    }
    // In ARGoS3, too, the focal length determines none of the angles of the image, and eye-bots ignore camera_front.
    const RobotRow& row = *RobotOfKind(robot);
    std::set<std::string> known{"id"};
    if (robot == kDemiurgeEPuck)
      known.insert("omnidirectional_camera_aperture");
    else if (!row.radio_range_name.empty())
      known.emplace(row.radio_range_name);
    if (!row.has_own_messages) known.insert("rab_data_size");
    if (robot == "footbot")
      known.insert({"omnidirectional_camera_aperture", "perspective_camera_aperture", "perspective_camera_range",
                    "perspective_camera_front"});
    if (row.flies) known.insert({"camera_aperture", "camera_range"});
    NoteOthers(theirs, known);
    if (robot == "footbot" && !Flag(theirs, "perspective_camera_front", true))
      Mistake(FindAttributeOf(theirs, "perspective_camera_front")->location,
              "a perspective camera that looks up has no counterpart; leave 'perspective_camera_front' out");
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
    NoteOtherChildren(theirs, {"body", "leds"});
  }
  else if (theirs.name == "cylinder")
  {
    made = AddNode(parent, "cylindric_prey", at);
    SetValue(*made, "radius", TextOf(NeededNumber(theirs, "radius")), at);
    SetValue(*made, "height", TextOf(NeededNumber(theirs, "height")), at);
    // Cameras of ARGoS3 see LEDs and lights, not bodies.
    const ConfigurationNode* leds = FindChild(theirs, "leds");
    SetValue(*made, "colour", leds == nullptr ? "black" : ColourOfLeds(*leds), at);
    SetMovable(theirs, *made);
    NoteOthers(theirs, {"id", "radius", "height", "movable", "mass"});
    NoteOtherChildren(theirs, {"body", "leds"});
  }
  else if (theirs.name == "light")
  {
    made = AddNode(parent, "light_bulb", at);
    NoteMedium(theirs);
    SetValue(*made, "intensity", TextOf(Number(theirs, "intensity", 1)), at);
    SetValue(*made, "colour", Colour(theirs, "yellow"), at);
    NoteOthers(theirs, {"id", "position", "color", "intensity", "medium"});
    NoteOtherChildren(theirs, {});
  }
  else
  {
    Mistake(at, "<" + theirs.name + "> has no counterpart; those that have: " + RobotTags() +
                    ", box, cylinder, light, floor, distribute");
    return;
  }
  kinds_.insert(made->name);
  SetValue(*made, "id", id, at);
  if (FindChild(theirs, "leds") != nullptr && theirs.name != "cylinder" && theirs.name != "box")
    Mistake(FindChild(theirs, "leds")->location, "LEDs on <" + theirs.name + "> have no counterpart; leave them out");
  if (placed) SetPlace(theirs, *made, lift);
}

std::string ArenaConverter::Colour(const ConfigurationNode& node, const std::string& fallback)
{
  const std::string colour = Text(node, "color").value_or(fallback);
  if (const auto ours = OurColour(colour)) return *ours;
  Mistake(FindAttributeOf(node, "color")->location,
          Quoted(colour) + " is no colour; write a name, or red,green,blue from 0 to 255");
  return fallback;
}

void ArenaConverter::NoteMedium(const ConfigurationNode& node)
{
  const auto medium = Text(node, "medium");
  if (medium && !media_.contains({"led", *medium}))
    Note(FindAttributeOf(node, "medium")->location, MissingMedium(node.name, "led", *medium));
}

std::string ArenaConverter::ColourOfLeds(const ConfigurationNode& leds)
{
  NoteOthers(leds, {"medium"});
  NoteMedium(leds);
  NoteOtherChildren(leds, {"led"});
  std::string first;
  for (const auto& led : leds.children)
  {
    if (led->name != "led") continue;
    NoteOthers(*led, {"color"});
    const std::string colour = Colour(*led, "black");
    if (first.empty()) first = colour;
    if (colour != first) Note(led->location, "all LEDs of one object have the colour of the first one here");
  }
  return first.empty() ? "black" : first;
}

void ArenaConverter::KeepSpare(const std::string& controller, const std::string& kind, int quantity)
{
  std::vector<Variant>& variants = variants_[controller];
  if (variants.empty()) variants.push_back({controller, {}});
  variants.front().bearers.kinds.insert(kind);
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
    if (shape.movable) SetGroundFriction(shape.tag == kLitBox ? "box" : "cylinder", shape.mass_kg, at, *body);
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
  SetGroundFriction(theirs.name, mass_kg, theirs.location, made);
}

// Our engine takes a coefficient for sliding.
void ArenaConverter::SetGroundFriction(const std::string& tag, double mass_kg, const SourceLocation& at,
                                       ConfigurationNode& made)
{
  if (!ground_ || !(mass_kg > 0)) return;
  constexpr double kGravity = 9.81;            // of our dynamics2d, m/s2
  constexpr double kLargestCoefficient = 100;  // that an entity may have
  const bool is_box = tag == "box";
  const double force = is_box ? ground_->box_force : ground_->cylinder_force;
  SetValue(made, "ground_friction", TextOf(std::min(force / (mass_kg * kGravity), kLargestCoefficient)), at);
  SetValue(made, "ground_torque", TextOf(is_box ? ground_->box_torque : ground_->cylinder_torque), at);
}

// Returns rotations about the fixed axes x, y and z for ARGoS3's rotations about z, y and x, in degrees.
Vector3 ArenaConverter::FixedAngles(const Vector3& zyx)
{
  // A plain heading stays as it is.
  if (zyx.y() == 0 && zyx.z() == 0) return {0, 0, zyx.x()};
  const EulerAngles fixed = EulerFromQuaternion(OrientationOf(zyx));
  return Vector3(fixed.alpha, fixed.beta, fixed.gamma) / kRadians;
}

Quaternion ArenaConverter::OrientationOf(const Vector3& zyx)
{
  return Quaternion(Eigen::AngleAxisd(zyx.z() * kRadians, Vector3::UnitX())) *
         Eigen::AngleAxisd(zyx.y() * kRadians, Vector3::UnitY()) *
         Eigen::AngleAxisd(zyx.x() * kRadians, Vector3::UnitZ());
}

bool ArenaConverter::KeepsTilt(const std::string& tag) const
{
  return !ground_ && (!has_point_masses_ || KindOf(tag).empty());
}

void ArenaConverter::SetPlace(const ConfigurationNode& theirs, ConfigurationNode& made, double lift)
{
  const bool is_light = theirs.name == "light";
  const ConfigurationNode* body = is_light ? &theirs : Needed(theirs, "body");
  if (body == nullptr) return;
  if (!is_light)
  {
    NoteOthers(*body, {"position", "orientation"});
    NoteOtherChildren(*body, {});
  }
  Vector3 zyx = Vector(*body, "orientation");
  if ((zyx.y() != 0 || zyx.z() != 0) && !is_light && !KeepsTilt(theirs.name))
  {
    Note(FindAttributeOf(*body, "orientation")->location, kTiltLost);
    zyx = {zyx.x(), 0, 0};
  }
  const Vector3 position = NeededVector(*body, "position") + origin_ + OrientationOf(zyx) * Vector3(0, 0, lift);
  SetValue(made, "position", TextOf(position), body->location);
  if (!is_light) SetValue(made, "orientation", TextOf(FixedAngles(zyx)), body->location);
}

void ArenaConverter::ConvertDistribute(const ConfigurationNode& theirs, ConfigurationNode& parent)
{
  const SourceLocation& at = theirs.location;
  const ConfigurationNode* position = Needed(theirs, "position");
  const ConfigurationNode* orientation = Needed(theirs, "orientation");
  const ConfigurationNode* entity = Needed(theirs, "entity");
  if (position == nullptr || orientation == nullptr || entity == nullptr) return;
  NoteOthers(theirs, {});
  NoteOtherChildren(theirs, {"position", "orientation", "entity"});
  NoteOthers(*entity, {"quantity", "max_trials", "base_num"});
  for (const ConfigurationNode* generator : {position, orientation})
  {
    const std::string method = Text(*generator, "method").value_or("");
    NoteOthers(*generator, method == "uniform"    ? std::set<std::string>{"method", "min", "max"}
                           : method == "gaussian" ? std::set<std::string>{"method", "mean", "std_dev"}
                           : method == "constant" ? std::set<std::string>{"method", "values"}
                                                  : std::set<std::string>{"method", "center", "distances", "layout"});
  }
  if (Whole(*entity, "quantity", 1) == 0) return;
  const Made made = AddNode(parent, "distribute", at);
  NeededText(*entity, "quantity");
  NeededText(*entity, "max_trials");
  SetValue(*made, "quantity", std::to_string(Whole(*entity, "quantity", 1)), entity->location);
  SetValue(*made, "max_trials", std::to_string(Whole(*entity, "max_trials", 1)), entity->location);
  const Made positions = AddNode(*made, "position", position->location);
  if (entity->children.size() != 1) return Mistake(entity->location, "<entity> holds one element: what is distributed");
  const ConfigurationNode& what = *entity->children.front();
  ConvertOrientations(*orientation, what.name, *AddNode(*made, "orientation", orientation->location));
  // Our position is the middle of a box; in ARGoS3 it is the middle of the base.
  ConvertPositions(*position, *positions, what.name == "box" ? NeededVector(what, "size").z() / 2 : 0);
  const std::string id = NeededText(what, "id");
  const long long first = Whole(*entity, "base_num", 0);
  if (first < 0)
    Mistake(entity->location, "'base_num' is " + std::to_string(first) + "; entities are numbered from 0 on");
  groups_.insert(id);
  const std::string ours = OurIdOfDistributed(what, first, Whole(*entity, "quantity", 1));
  distributed_ += fmt::format("{}{}:{}:{}", distributed_.empty() ? "" : " ", Encoded(id), first, ours);
  ConvertEntity(what, ours, *made, false);
}

std::string ArenaConverter::OurIdOf(const ConfigurationNode& theirs)
{
  const std::string id = NeededText(theirs, "id");
  const auto known = our_ids_.find(id);
  if (known != our_ids_.end()) return known->second;
  const std::string wanted = OurCharacters(id);
  std::string ours = wanted;
  for (int number = 2; ours != id && (single_ids_.contains(ours) || used_ids_.contains(ours)); ++number)
    ours = fmt::format("{}.{}", wanted.substr(0, 56), number);
  used_ids_.insert(ours);
  our_ids_[id] = ours;
  if (ours != id) Note(theirs.location, Quoted(id) + " has the id '" + ours + "' in our tools");
  return ours;
}

// The id of a single entity may look like that of a distributed one, such as fb7.
void ArenaConverter::AddTranslations()
{
  const auto looks_distributed = [&](const std::string& id)
  {
    return std::ranges::any_of(groups_, [&](const std::string& group)
                               { return id.starts_with(group) && ParseInteger(id.substr(group.size())).has_value(); });
  };
  for (const auto& [id, ours] : our_ids_)
    if (ours != id || looks_distributed(id))
      distributed_ += fmt::format("{}{}::{}", distributed_.empty() ? "" : " ", Encoded(id), ours);
}

std::string ArenaConverter::OurIdOfDistributed(const ConfigurationNode& what, long long first, long long quantity)
{
  std::string id = Text(what, "id").value_or("");
  if (id.empty()) id = KindOf(what.name).empty() ? what.name : KindOf(what.name);
  id = OurCharacters(id).substr(0, 48);
  const std::string wanted = id;
  // Returns whether another entity has one of the ids `id`_0, `id`_1 …
  const auto is_taken = [&]
  {
    if (distributed_ids_.contains(id)) return true;
    for (const std::string& single : single_ids_)
      if (single.starts_with(id + "_"))
        if (const auto number = ParseInteger(single.substr(id.size() + 1))) return *number >= 0 && *number < quantity;
    return false;
  };
  if (is_taken() && first != 0) id = fmt::format("{}.{}", wanted, first);
  for (int number = 2; is_taken(); ++number) id = fmt::format("{}.{}", wanted, number);
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
    // ARGoS3 fills a grid from the largest coordinates on.
    SetValue(made, "spacing", TextOf(Vector3(-NeededVector(theirs, "distances"))), theirs.location);
    same("layout", "layout");
  }
  else
    Mistake(theirs.location, Quoted(method) + " is no method; uniform, gaussian, constant and grid are");
}

void ArenaConverter::ConvertOrientations(const ConfigurationNode& theirs, const std::string& tag,
                                         ConfigurationNode& made)
{
  const std::string method = NeededText(theirs, "method");
  SetValue(made, "method", method, theirs.location);
  struct Value
  {
    const char* theirs;
    const char* ours;
    Vector3 angles;  // about z, y and x
  };
  std::vector<Value> values;
  const auto read = [&](const char* from, const char* to) { values.push_back({from, to, NeededVector(theirs, from)}); };
  if (method == "uniform")
  {
    read("min", "min");
    read("max", "max");
  }
  else if (method == "gaussian")
  {
    read("mean", "mean");
    read("std_dev", "deviation");
  }
  else if (method == "constant")
    read("values", "value");
  else if (method == "grid")
  {
    read("center", "centre");
    read("distances", "spacing");
    read("layout", "layout");
    const Vector3& layout = values[2].angles;
    Vector3& spacing = values[1].angles;
    for (const int axis : {0, 1, 2}) spacing[axis] = layout[axis] == 1 ? 0 : -spacing[axis];
  }
  else
    return Mistake(theirs.location, Quoted(method) + " is no method; uniform, gaussian, constant and grid are");
  bool tilts = false;
  for (const Value& value : values)
  {
    const bool is_layout = std::string_view(value.theirs) == "layout";
    const auto* attribute = FindAttributeOf(theirs, value.theirs);
    if (is_layout || attribute == nullptr || (value.angles.y() == 0 && value.angles.z() == 0)) continue;
    tilts = KeepsTilt(tag);
    if (!tilts) Note(attribute->location, kTiltLost);
  }
  if (tilts) SetValue(made, "axes", "zyx", theirs.location);
  for (const Value& value : values)
  {
    const Vector3& zyx = value.angles;
    const bool is_layout = std::string_view(value.theirs) == "layout";
    const Vector3 heading = is_layout ? Vector3(1, 1, zyx.x()) : Vector3(0, 0, zyx.x());
    SetValue(made, value.ours, TextOf(tilts ? zyx : heading), theirs.location);
  }
}

}  // namespace swarmanoid::argos3
