// The table of entity kinds: a row says all that the simulator has to know of a kind of robot or object. The reader of
// experiment files, the space, the engines, the sensors and the visualisers ask the row. The simulator's own kinds are
// rows (own_kinds.cpp); a user's library adds others by REGISTER_ENTITY_KIND, and an experiment names it:
//
//   <entity_kinds><epuck library="epuck"/></entity_kinds>
//
// Rows are added before roles start, and read-only afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/math/pose.h"

namespace swarmanoid
{

// A row of the table. Those that are named are the simulator's own; the rows of users follow in the order in which they
// are registered.
enum class EntityKind : std::uint8_t
{
  kFootbot,
  kHandbot,
  kEyebot,
  kBlock,
  kCylindricPrey,
  kLightBulb,
  kSoundSource,
  kGroundPatch,
  kHole,
  kWall,
  kTerrain
};

enum class EntityRole : std::uint8_t
{
  kRobot,  // may have a controller
  kObject,
  kLight,
  kSound,
  kPatch,  // of the floor
  kHole,   // in the floor
  kTerrain
};

enum class BodyForm : std::uint8_t
{
  kNone,
  kCylinder,  // upright
  kBox
};

// What the position of a body is.
enum class BodyOrigin : std::uint8_t
{
  kBase,   // the centre of its base: engines of planes stand it on the plane
  kCentre  // the centre of the body: engines of planes keep its height and lean
};

enum class Mobility : std::uint8_t
{
  kNever,
  kAlways,
  kIfAsked  // by its parameter "movable"
};

// What engines and visualisers have code of their own for.
enum class Mechanism : std::uint8_t
{
  kNone,
  kTurretGripper,  // the footbot: a turret with a gripper at its front
  kArms,           // the handbot: a head with two arms, and a rope to climb
  kPropellers      // the eyebot: it flies, and hangs on the ceiling
};

// What the number in a slot of an attribute stands for, and so which numbers may enter the state.
enum class AttributeValue : std::uint8_t
{
  kNumber,   // finite, at most 1e9 from 0
  kColour,   // 0xRRGGBB: a whole number from 0 to 0xffffff
  kSwitch,   // 0 or 1
  kEntity,   // 1 + index of an entity, or 0
  kBytes,    // up to five bytes: a whole number from 0 to 2^40 - 1
  kPresence  // 1 in the arena, 0 not: set by the space server alone
};

// Numbers of an entity beside its pose that all processes see.
struct AttributeSpec
{
  std::string_view name;
  int count;       // slots
  double initial;  // of each slot; "colour" and "intensity" start as the experiment file says
  std::string_view description;
  AttributeValue value = AttributeValue::kNumber;
};

// Two wheels on one axis through the origin, y to the left.
struct WheelDrive
{
  double axle_m = 0;  // between the wheels
  double radius_m = 0;
  double max_speed_m_s = 0.3;  // of a wheel on the ground
};

// LEDs, all at one height. Attribute "led".
struct LedLayout
{
  std::vector<Vector2> places;  // m, in the frame of the robot, x forward
  double height_m = 0;
  bool on_turret = false;  // turns by the attribute "turret_angle"
  // Where each LED looks as one of directional_leds, of any length; empty: outwards from the middle.
  std::vector<Vector3> directions{};
};
// `count` places on a circle, counter-clockwise from `first_angle` (radians, 0 is the front).
std::vector<Vector2> PlacesOnCircle(int count, double radius_m, double first_angle);

// Infrared sensors that look outwards, horizontally.
struct ProximityRing
{
  struct Sensor
  {
    Vector2 place;         // m, in the frame of the robot
    double direction = 0;  // rad, counter-clockwise from the front
  };
  std::vector<Sensor> sensors;
  double height_m = 0;
  double range_m = 0;
};

// A simple part of what a visualiser draws, in the frame of the entity, in metres.
struct MeshPart
{
  enum class Form : std::uint8_t
  {
    kBox,   // from one corner to the opposite one
    kRod,   // a cylinder of a radius from one point to the other
    kBall,  // about `from`
    kFile   // what `file` holds, its origin at `from`
  };
  enum class Paint : std::uint8_t
  {
    kBody,  // the colour of the row, or of the attribute "colour"
    kDark,
    kShell,  // light plastic
    kMetal,
    kRubber,
    kGlass,
    kLed,     // the colour of LED `led`
    kBeacon,  // the colour of the beacon
    kOwn      // `colour`
  };
  Form form = Form::kBox;
  Vector3 from = Vector3::Zero();
  Vector3 to = Vector3::Zero();
  double radius = 0;
  Paint paint = Paint::kBody;
  int led = 0;
  std::uint32_t colour = 0xc0c0c0;
  // A mesh: .glb, .gltf, .obj or .stl, from the folder of the experiment or of a library (mesh_files.h). `paint` is
  // that of a file without colours. In metres times `scale`, z up and x to the front, then turned.
  std::string file{};
  Vector3 scale = Vector3::Ones();
  Quaternion orientation = Quaternion::Identity();
};

struct EntityKindDescription
{
  std::string tag{};                        // the XML tag: letters, digits, '_'
  std::string word{};                       // in tables: "CylindricPrey"; empty: the tag
  std::string short_word{};                 // in narrow columns: "prey"; empty: the tag
  std::vector<std::string> further_tags{};  // accepted for the tag
  std::string description{};                // a sentence or two for the reference pages
  EntityRole role = EntityRole::kRobot;

  BodyForm form = BodyForm::kNone;
  BodyOrigin origin = BodyOrigin::kBase;
  // Of the body, m: a box along x, y and z; a cylinder's radius, radius and height. Zero: each entity gives its own, by
  // the parameters "size", or "radius" and "height".
  Vector3 size = Vector3::Zero();
  // Of a box: the body is the convex hull of these points instead, m, in the frame of the entity, within the box.
  std::vector<Vector3> corners{};
  double mass_kg = 0;  // of an entity without one of its own; 0: engines take their own for it, or their density
  Mobility mobility = Mobility::kAlways;
  bool grippable = false;           // grippers find hold on it while it can move
  int grippers = 0;                 // what it has itself: attribute "gripped"
  std::uint32_t colour = 0xc0c0c0;  // of one without a parameter "colour"

  // Parameters of its element beside id, position and orientation. What follows from the rest of a user's row is added
  // when it is registered: controller of robots; size, or radius and height; movable, mass, colour of objects …
  std::vector<ParameterSpec> parameters{};
  // In the order of the slots. Added likewise, in front: led, beacon; colour; intensity.
  std::vector<AttributeSpec> attributes{};

  std::optional<WheelDrive> wheels{};
  std::optional<LedLayout> leds{};
  std::optional<double> beacon_height_m{};  // an LED above the middle. Attribute "beacon"
  bool seen_by_cameras = false;             // by its attribute "colour"; LEDs always are
  std::optional<ProximityRing> proximity{};
  std::vector<Vector2> ground_points{};  // m: where the ground sensors look
  // Further types of devices that it can carry, of those whose own list of robots does not have it.
  std::vector<std::string> devices{};

  std::vector<MeshPart> mesh{};  // none: its body, with its LEDs
  double label_height_m = 0;     // of its name above its position; 0: a little above the body

  Mechanism mechanism = Mechanism::kNone;  // for the simulator's own rows
};

// The row of a kind. Throws std::out_of_range for one that is not registered.
const EntityKindDescription& DescriptionOf(EntityKind kind);
// All rows are the kinds from 0 on.
std::size_t EntityKindCount();
bool IsBuiltIn(EntityKind kind);
// By its tag, under any of its names ("cyllindric_prej"); nullopt for no kind.
std::optional<EntityKind> KindOfTag(std::string_view tag);

// Adds a row. While a library is loaded, what is wrong with it is kept as a problem of that library (as in
// PluginCatalogue::Add); otherwise std::invalid_argument is thrown.
void RegisterEntityKind(EntityKindDescription description);

bool IsRobot(EntityKind kind);
// Lights, sounds and patches of the floor: no engine holds a body of them.
bool IsBodiless(EntityKind kind);
bool HasBody(EntityKind kind);
// A body that keeps its height and lean on planes, such as a block: they cut it.
bool IsFreeBox(EntityKind kind);
// Whether some part of a robot takes a type of device that is made for all robots with that part: "wheels", "led_ring",
// "directional_leds", "proximity", "ground"; or its row names the type.
bool Carries(EntityKind kind, std::string_view device_type);
// Whether one may be added to the arena and removed while the experiment runs.
bool CanWait(EntityKind kind);
// The words of the tables and files: "Footbot", "Block" (figure 3.11) and "footbot", "block".
std::string_view TableName(EntityKind kind);
std::string_view TagName(EntityKind kind);
// The tags of the rows that fit.
template <class Fits>
std::vector<std::string> TagsOfKinds(Fits fits)
{
  std::vector<std::string> tags;
  for (std::size_t k = 0; k < EntityKindCount(); ++k)
    if (const auto kind = static_cast<EntityKind>(k); IsBuiltIn(kind) && fits(DescriptionOf(kind)))
      tags.emplace_back(TagName(kind));
  return tags;
}

struct EntityKindRegistration
{
  explicit EntityKindRegistration(EntityKindDescription description) { RegisterEntityKind(std::move(description)); }
};

}  // namespace swarmanoid

// REGISTER_ENTITY_KIND(epuck, description): a row of the table. The first word tells the registrations of a file apart.
#define REGISTER_ENTITY_KIND(NAME, ...)                                           \
  namespace                                                                       \
  {                                                                               \
  const ::swarmanoid::EntityKindRegistration registration_of_##NAME{__VA_ARGS__}; \
  }
