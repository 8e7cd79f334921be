// The table of entity kinds: a row holds all that the simulator has to know about a kind of robot or object. The reader
// of experiment files, the space, the engines, the sensors and the visualisers read the row. The simulator's own kinds
// are rows (builtin_kinds.cpp). A user's library adds others by REGISTER_ENTITY_KIND, and an experiment names it:
//
//   <entity_kinds><epuck library="epuck"/></entity_kinds>
//
// Rows are added before roles start, and are read-only afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/experiment/moving_links.h"
#include "common/math/pose.h"

namespace swarmanoid
{

// A kind is the number of a row of the table. The named kinds are the simulator's own. The rows of users follow in the
// order of their registration.
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
  kTerrain,
  kChargingStation
};

enum class EntityRole : std::uint8_t
{
  kRobot,  // may have a controller
  kObject,
  kLight,
  kSound,
  kPatch,  // an area of the floor
  kHole,   // a hole in the floor
  kTerrain
};

enum class BodyForm : std::uint8_t
{
  kNone,
  kCylinder,  // upright
  kBox
};

// The point of a body that its position gives.
enum class BodyOrigin : std::uint8_t
{
  kBase,   // the centre of its base: engines of planes stand it on the plane
  kCentre  // the centre of the body: engines of planes keep its height and lean
};

enum class Mobility : std::uint8_t
{
  kNever,
  kAlways,
  kIfAsked  // movable if the parameter "movable" says so
};

// Mechanisms that engines and visualisers have special code for.
enum class Mechanism : std::uint8_t
{
  kNone,
  kTurretGripper,  // the footbot: a turret with a gripper at its front
  kArms,           // the handbot: a head with two arms, and a rope to climb
  kPropellers      // the eyebot: four rotors in a ring, and a laser
};

// It tells the meaning of the numbers of an attribute, and so which numbers may enter the state.
enum class AttributeValue : std::uint8_t
{
  kNumber,    // finite, at most 1e9 from 0
  kColour,    // 0xRRGGBB: a whole number from 0 to 0xffffff
  kSwitch,    // 0 or 1
  kEntity,    // 1 + index of an entity, or 0
  kBytes,     // up to five bytes: a whole number from 0 to 2^40 - 1
  kPresence,  // 1 in the arena, 0 not: set by the space server alone
  kEngine     // the number of an engine of the experiment: set by the space server alone
};

// Numbers of an entity, beside its pose, that all processes see.
struct AttributeSpec
{
  std::string_view name;
  int count;       // slots
  double initial;  // value of each slot; "colour" and "intensity" start as the experiment file says
  std::string_view description;
  AttributeValue value = AttributeValue::kNumber;
};

// A robot on wheels has two of them on one axis through the origin, y to the left.
struct WheelDrive
{
  double axle_m = 0;  // between the wheels
  double radius_m = 0;
  double max_speed_m_s = 0.3;  // the greatest speed of a wheel on the ground
};

// The rotors of a flying robot stand evenly on a circle, all at one height. The first one is half a spacing to the left
// of the front, and turns clockwise. Neighbours turn opposite ways.
struct Rotors
{
  int count = 4;            // even, at least 4
  double reach_m = 0;       // from the middle to each rotor
  double max_thrust_n = 0;  // of each
  double torque_m = 0;      // torque about a rotor's axis, for each newton of its thrust
  // A rotor that turns at w (rad/s) has the thrust x + y w + z w² (N). Its largest root is the speed without thrust.
  Vector3 thrust_of_speed = Vector3::Zero();
  // Its speed follows the command with a first-order lag of these time constants. 0: at once.
  double spin_up_s = 0;
  double spin_down_s = 0;
  // The rotors' drag along the robot's own axes, in N for 1 m/s of air and 1 rad/s of all rotors' speeds together.
  Vector3 drag = Vector3::Zero();
};

// A robot that flies pushes along its own z axis. An autopilot in the engine holds the commanded velocities: a place
// loop asks for an acceleration, and an attitude loop tilts the robot towards it. All loops are critically damped.
struct Propellers
{
  double max_thrust_n = 0;                  // if the row has no rotors
  Vector3 inertia_kg_m2 = Vector3::Zero();  // about the centre of mass, along x, y and z, at `mass_kg`
  double centre_of_mass_m = 0;              // height above the base

  // Limits of the commands: speed along each axis, and yaw rate.
  double max_speed_m_s = 1;
  double max_yaw_rate_rad_s = 1.57079633;
  // Limits of the autopilot.
  double max_across_m_s2 = 3;
  double max_upward_m_s2 = 5;
  double max_angular_rad_s2 = 60;
  double furthest_reference_m = 0.25;  // the commanded place is at most so far ahead, on each axis
  // Frequencies of its loops.
  double place_rad_s = 3;
  double tilt_rad_s = 12;
  double yaw_rad_s = 6;

  // The horizontal force and the yaw torque in dynamics2d, at most.
  double plane_force_n = 0;
  double plane_torque_n_m = 0;
  // A magnet holds its top to a ceiling at most so far above. 0: the robot has no magnet.
  double magnet_reach_m = 0;
  // The drag of a robot without rotors, along its axes, in N for 1 m/s of air. It acts only in an arena with <wind>.
  Vector3 drag_in_wind = Vector3::Zero();
  // If they are missing, thrust and torques are as commanded at once.
  std::optional<Rotors> rotors{};
};

// One of the simple solids that form a body in dynamics3d, upright, in the frame of the robot.
struct SolidPart
{
  enum class Form : std::uint8_t
  {
    kCylinder,  // size: radius, radius, height
    kBox,
    kCapsule  // size: radius, radius, height without the round ends
  };
  Form form = Form::kCylinder;
  Vector3 centre = Vector3::Zero();
  Vector3 size = Vector3::Zero();
};

// LEDs of a robot are all at one height. They set the attribute "led".
struct LedLayout
{
  std::vector<Vector2> places;  // m, in the frame of the robot, x forward
  double height_m = 0;
  bool on_turret = false;  // the LEDs turn by the attribute "turret_angle"
  // Each LED has a direction, as one of directional_leds, of any length. If there are none, the LEDs shine outwards
  // from the middle.
  std::vector<Vector3> directions{};
};
// Returns `count` places on a circle, counter-clockwise from `first_angle` (radians, 0 is the front).
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

// A drawn mesh consists of such simple shapes, in the frame of the entity, in metres.
struct MeshPart
{
  enum class Form : std::uint8_t
  {
    kBox,   // from one corner to the opposite one
    kRod,   // a cylinder of a radius from one point to the other
    kBall,  // about `from`
    kFile   // the content of `file`, with its origin at `from`
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
    kOwn      // the colour `colour`
  };
  Form form = Form::kBox;
  Vector3 from = Vector3::Zero();
  Vector3 to = Vector3::Zero();
  double radius = 0;
  Paint paint = Paint::kBody;
  int led = 0;
  std::uint32_t colour = 0xc0c0c0;
  // A mesh file: .glb, .gltf, .obj or .stl, from the folder of the experiment or of a library (mesh_files.h). `paint`
  // applies to files without colours. The mesh is in metres times `scale`, z up and x to the front, then turned.
  std::string file{};
  Vector3 scale = Vector3::Ones();
  Quaternion orientation = Quaternion::Identity();
  // The link that the part moves with, an index into EntityKindDescription::links. It is placed with all joints at 0.
  int link = MovingLink::kBase;
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
  // The size of the body in m: a box along x, y and z, or a cylinder's radius, radius and height. Zero: each entity
  // gives its own, by the parameters "size", or "radius" and "height".
  Vector3 size = Vector3::Zero();
  // If not empty, the body of a box is the convex hull of these points, in m, in the frame of the entity, within the
  // box.
  std::vector<Vector3> corners{};
  double mass_kg = 0;  // default mass; 0: engines use their own mass or density
  Mobility mobility = Mobility::kAlways;
  bool grippable = false;           // grippers can hold it if it is movable
  int grippers = 0;                 // number of its own grippers; each has a slot of the attribute "gripped"
  std::uint32_t colour = 0xc0c0c0;  // default, for entities without a parameter "colour"

  // Parameters of its element beside id, position and orientation. Registration adds the parameters that follow from
  // the rest of a user's row: controller for robots; size, or radius and height; movable, mass and colour for objects.
  std::vector<ParameterSpec> parameters{};
  // Attributes in the order of the slots. Registration adds led, beacon, colour and intensity in front, if the row has
  // them.
  std::vector<AttributeSpec> attributes{};

  std::optional<WheelDrive> wheels{};
  std::optional<Propellers> propellers{};
  std::vector<SolidPart> solids{};  // of a robot that flies; empty: one of its form and size
  // Links that joints move, for robots without propellers. Without wheels, the robot stands on them or on its base, and
  // `base` is the body that carries them. A robot on wheels is that body itself.
  std::vector<MovingLink> links{};
  std::optional<LinkBody> base{};
  std::optional<LedLayout> leds{};
  std::optional<double> beacon_height_m{};  // height of an LED above the middle; it sets the attribute "beacon"
  bool seen_by_cameras = false;             // by its attribute "colour"; LEDs are always seen
  std::optional<ProximityRing> proximity{};
  std::vector<Vector2> ground_points{};  // m: the points under the ground sensors
  // Further types of devices that it can carry, if a device's own list of robots does not have this kind.
  std::vector<std::string> devices{};

  std::vector<MeshPart> mesh{};  // empty: its body, with its LEDs
  double label_height_m = 0;     // height of its name above its position; 0: a little above the body

  Mechanism mechanism = Mechanism::kNone;  // for the simulator's own rows
};

// Returns the row of a kind. Throws std::out_of_range for a kind that is not registered.
const EntityKindDescription& DescriptionOf(EntityKind kind);
// Returns the number of rows. The kinds are the numbers from 0 on.
std::size_t EntityKindCount();
bool IsBuiltIn(EntityKind kind);
// Returns the kind of a tag, under any of its names ("cyllindric_prej"); nullopt for an unknown tag.
std::optional<EntityKind> KindOfTag(std::string_view tag);

// Adds a row. While a library is loaded, a mistake in the row is kept as a problem of that library (as in
// PluginCatalogue::Add). Otherwise std::invalid_argument is thrown.
void RegisterEntityKind(EntityKindDescription description);

// Returns whether the kind has the role of a robot.
bool IsRobot(EntityKind kind);
// Returns whether no engine holds a body of the kind: lights, sounds and patches of the floor.
bool IsBodiless(EntityKind kind);
bool HasBody(EntityKind kind);
// Returns whether engines on a plane cut the body and keep its height and lean, as for a block.
bool IsFreeBox(EntityKind kind);
// Returns whether only an engine that moves links can move the kind: it has no wheels or propellers, but joints.
bool StandsOnLinks(EntityKind kind);
// Returns whether a kind can carry a type of device. Types for all robots with a part are "wheels", "joints",
// "led_ring", "directional_leds", "proximity" and "ground". Robots with propellers carry "eyebot_propellers",
// "eyebot_altitude" and "eyebot_camera", and with a magnet "eyebot_attachment". A row can name further types.
bool Carries(EntityKind kind, std::string_view device_type);
// Returns whether entities of the kind may be added to the arena and removed during a run.
bool CanWait(EntityKind kind);
// Return the words for tables and files: "Footbot", "Block" (figure 3.11) and "footbot", "block".
std::string_view TableName(EntityKind kind);
std::string_view TagName(EntityKind kind);
// Returns the tags of the rows that `fits` accepts.
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

// REGISTER_ENTITY_KIND(epuck, description) adds a row to the table. The first word distinguishes the registrations of a
// file.
#define REGISTER_ENTITY_KIND(NAME, ...)                                           \
  namespace                                                                       \
  {                                                                               \
  const ::swarmanoid::EntityKindRegistration registration_of_##NAME{__VA_ARGS__}; \
  }
