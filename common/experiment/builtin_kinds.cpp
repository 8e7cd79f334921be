#include "common/experiment/builtin_kinds.h"

#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/experiment/battery_model.h"
#include "common/experiment/schema_parts.h"
#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

ParameterSpec ContactParameter(const char* name, const char* description, double maximum)
{
  return {name, kNumber, "", "", description, 0, maximum};
}

constexpr AttributeSpec kMessage{"message", 3, 0,
                                 "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                                 AttributeValue::kBytes};
constexpr AttributeSpec kRadio{"radio", 8, 0,
                               "radio: packets sent so far, bytes of the last one, the bytes by fives as numbers",
                               AttributeValue::kBytes};
constexpr AttributeSpec kReport{"report", 8, 0, "reports to experiment functions, as those of the radio",
                                AttributeValue::kBytes};
constexpr AttributeSpec kInstruction{"instruction", 8, 0, "also instructions of experiment functions",
                                     AttributeValue::kBytes};
constexpr AttributeSpec kBeacon{"beacon", 1, 0, "colour of the beacon", AttributeValue::kColour};
constexpr AttributeSpec kSurface{"colour", 1, 0xc0c0c0, "colour of the surface", AttributeValue::kColour};

// Places the sensors evenly around the robot, the first one half a spacing to the left of the front.
ProximityRing RingOfSensors(int count, double radius_m, double height_m, double range_m)
{
  ProximityRing ring;
  ring.height_m = height_m;
  ring.range_m = range_m;
  for (int i = 0; i < count; ++i)
  {
    const double angle = (2 * i + 1) * (kPi / count);
    ring.sensors.push_back({radius_m * Vector2(Cos(angle), Sin(angle)), angle});
  }
  return ring;
}

EntityKindDescription Footbot()
{
  // Radius, height, wheels and rings are those of the foot-bot in ARGoS3.
  constexpr double kRadius = 0.085036758;
  constexpr int kProximitySensors = 24;
  EntityKindDescription row;
  row.tag = "footbot";
  row.word = "Footbot";
  row.description = "A footbot: a wheeled robot with a gripper. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, 0.146899733};
  row.grippable = true;
  row.grippers = 1;
  row.parameters = {ControllerParameter()};
  row.attributes = {
      {"led", 12, 0, "colours of the LED ring, counter-clockwise from 15 degrees left of the turret's front",
       AttributeValue::kColour},
      kBeacon,
      {"gripper_aperture", 1, 0, "aperture of the gripper in radians; 0 is closed"},
      {"gripped", 1, 0, "1 + index of the entity held by the gripper; 0: none", AttributeValue::kEntity},
      {"turret_angle", 1, 0, "angle of the turret against the body in radians"},
      kMessage,
      kRadio,
      kReport,
      kInstruction};
  row.wheels = WheelDrive{0.14, 0.029112741, 0.3};
  row.leds = LedLayout{PlacesOnCircle(12, kRadius + 0.005, kPi / 12), 0.085, true};
  row.beacon_height_m = 0.174;
  row.proximity = RingOfSensors(kProximitySensors, kRadius, 0.06, 0.1);
  for (const auto& [x, y] : CCI_FootBotBaseGroundSensor::PLACES_M) row.ground_points.emplace_back(x, y);
  row.label_height_m = 0.33;
  row.mechanism = Mechanism::kTurretGripper;
  return row;
}

EntityKindDescription Handbot()
{
  EntityKindDescription row;
  row.tag = "handbot";
  row.word = "Handbot";
  row.description = "A handbot: a climbing robot with two hands. The position is the centre of its base.";
  row.form = BodyForm::kBox;
  row.size = {0.22, 0.17, 0.16};
  row.grippable = true;
  row.grippers = 2;
  row.parameters = {ControllerParameter()};
  row.attributes = {{"led", 12, 0, "colours of the LED ring", AttributeValue::kColour},
                    kBeacon,
                    {"head_angle", 1, 0, "rotation of the head with the two arms in radians"},
                    {"arm", 2, 0, "apertures of the left and the right arm in radians"},
                    {"wrist", 2, 0, "rotations of the left and the right wrist in radians"},
                    {"hand_aperture", 2, 0, "apertures of the left and the right hand in radians; 0 is closed"},
                    {"gripped", 2, 0, "1 + index of the entity held by the left and the right hand; 0: none",
                     AttributeValue::kEntity},
                    {"rope_attached", 1, 0, "1 while the rope is attached to the ceiling", AttributeValue::kSwitch},
                    {"rope_length", 1, 0, "free length of the rope in metres"},
                    kMessage,
                    kRadio,
                    kReport,
                    kInstruction};
  // The places are an assumption: around the body, at half its height.
  row.leds = LedLayout{PlacesOnCircle(12, 0.09, kPi / 12), 0.08, false};
  row.beacon_height_m = 0.17;
  row.mechanism = Mechanism::kArms;
  return row;
}

EntityKindDescription Eyebot()
{
  // Ring, rod, legs and mass are those of the ODE model of ARGoS 2. Limits and frequencies are ours.
  constexpr double kRadius = 0.25;
  constexpr double kHeight = 0.566;
  constexpr double kRingCentre = 0.1735;
  constexpr double kRodSide = 0.07;
  constexpr double kRodLength = kHeight - kRingCentre;
  constexpr double kLegRadius = 0.01;
  constexpr double kLegReach = 0.12;
  constexpr double kLegLength = kRingCentre - 2 * kLegRadius;
  EntityKindDescription row;
  row.tag = "eyebot";
  row.word = "Eyebot";
  row.description = "An eyebot: a flying robot with a camera. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, kHeight};
  row.mass_kg = 0.5;
  row.parameters = {ControllerParameter()};
  row.attributes = {{"led", 16, 0, "colours of the LED ring", AttributeValue::kColour},
                    {"laser", 1, 0, "1 while the laser is on", AttributeValue::kSwitch},
                    {"laser_colour", 1, 0xff0000, "colour of the laser", AttributeValue::kColour},
                    {"laser_pan", 1, 0, "pan of the laser in radians"},
                    {"laser_tilt", 1, 0, "tilt of the laser from straight down in radians"},
                    {"attached", 1, 0, "1 while attached to the ceiling", AttributeValue::kSwitch},
                    kMessage,
                    kRadio,
                    kReport,
                    kInstruction};
  row.leds = LedLayout{PlacesOnCircle(16, 0.255, kPi / 16), 0.1535, false};
  row.proximity = RingOfSensors(24, 0.255, 0.1635, 3);
  // The thrust is 2.2 times the weight, and the inertia that of a cylinder of radius 0.18 m and height 0.3 m.
  row.propellers = Propellers{.max_thrust_n = 10.791,
                              .inertia_kg_m2 = {0.0078, 0.0078, 0.0081},
                              .centre_of_mass_m = 0.2,
                              .plane_force_n = 5,
                              .plane_torque_n_m = 0.2,
                              .magnet_reach_m = 0.03,
                              .drag_in_wind = {0.1, 0.1, 0.1}};
  row.solids = {{SolidPart::Form::kCylinder, {0, 0, kRingCentre}, {kRadius, kRadius, 0.03}},
                {SolidPart::Form::kBox, {0, 0, kRingCentre + kRodLength / 2}, {kRodSide, kRodSide, kRodLength}}};
  for (const double x : {kLegReach, -kLegReach})
    for (const double y : {kLegReach, -kLegReach})
      row.solids.push_back(
          {SolidPart::Form::kCapsule, {x, y, kLegRadius + kLegLength / 2}, {kLegRadius, kLegRadius, kLegLength}});
  row.mechanism = Mechanism::kPropellers;
  return row;
}

EntityKindDescription Block()
{
  EntityKindDescription row;
  row.tag = "block";
  row.word = "Block";
  row.description = "A brick, for obstacles, furniture and walls.";
  row.role = EntityRole::kObject;
  row.form = BodyForm::kBox;
  row.origin = BodyOrigin::kCentre;
  row.mobility = Mobility::kIfAsked;
  row.grippable = true;
  row.parameters = {BoxSizeParameter(),         MovableParameter(),        MassParameter(),
                    FrictionParameter(),        RestitutionParameter(),    GroundFrictionParameter(),
                    GroundTorqueParameter(),    ColourParameter("silver"), MeshParameter(),
                    MeshOrientationParameter(), ConvexParameter(),         CornersParameter()};
  row.attributes = {kSurface};
  return row;
}

EntityKindDescription CylindricPrey()
{
  EntityKindDescription row;
  row.tag = "cylindric_prey";
  row.word = "CylindricPrey";
  row.short_word = "prey";
  row.further_tags = {"cyllindric_prej"};
  row.description =
      "A cylinder that robots can grip and carry, or a pillar that stands. The position is the centre of its base.";
  row.role = EntityRole::kObject;
  row.form = BodyForm::kCylinder;
  row.mobility = Mobility::kIfAsked;
  row.grippable = true;
  row.seen_by_cameras = true;
  ParameterSpec movable = MovableParameter();
  movable.default_value = "true";
  row.parameters = {RadiusParameter(),         HeightParameter(),         movable,
                    MassParameter(),           FrictionParameter(),       RestitutionParameter(),
                    GroundFrictionParameter(), GroundTorqueParameter(),   ColourParameter("red"),
                    MeshParameter(),           MeshOrientationParameter()};
  row.attributes = {kSurface};
  return row;
}

EntityKindDescription LightBulb()
{
  EntityKindDescription row;
  row.tag = "light_bulb";
  row.word = "LightBulb";
  row.short_word = "light";
  row.description = "A light. It has no body.";
  row.role = EntityRole::kLight;
  row.mobility = Mobility::kNever;
  row.seen_by_cameras = true;
  row.parameters = {IntensityParameter(), ColourParameter("yellow")};
  row.attributes = {{"colour", 1, 0xffff00, "colour of the light", AttributeValue::kColour},
                    {"intensity", 1, 1, "intensity of the light"}};
  return row;
}

EntityKindDescription SoundSource()
{
  EntityKindDescription row;
  row.tag = "sound_source";
  row.word = "SoundSource";
  row.short_word = "sound";
  row.description = "A source of sound. It has no body.";
  row.role = EntityRole::kSound;
  row.mobility = Mobility::kNever;
  row.parameters = {IntensityParameter()};
  row.attributes = LightBulb().attributes;
  return row;
}

EntityKindDescription GroundPatch()
{
  EntityKindDescription row;
  row.tag = "ground_patch";
  row.word = "GroundPatch";
  row.short_word = "patch";
  row.further_tags = {"nest"};
  row.description = "A coloured area of the floor, such as the nest. Either size or radius is given.";
  row.role = EntityRole::kPatch;
  row.mobility = Mobility::kNever;
  row.seen_by_cameras = true;
  row.parameters = {AreaSizeParameter(), AreaRadiusParameter(), ColourParameter("green"), PictureParameter()};
  row.attributes = {kSurface};
  return row;
}

EntityKindDescription Hole()
{
  EntityKindDescription row;
  row.tag = "hole";
  row.word = "Hole";
  row.description = "An area without floor. Either size or radius is given.";
  row.role = EntityRole::kHole;
  row.mobility = Mobility::kNever;
  row.colour = 0;
  row.parameters = {AreaSizeParameter(), AreaRadiusParameter()};
  return row;
}

EntityKindDescription Wall()
{
  EntityKindDescription row;
  row.tag = "wall";
  row.word = "Wall";
  row.description = "A box that never moves.";
  row.role = EntityRole::kObject;
  row.form = BodyForm::kBox;
  row.origin = BodyOrigin::kCentre;
  row.mobility = Mobility::kNever;
  row.parameters = {BoxSizeParameter(), FrictionParameter(), RestitutionParameter(), ColourParameter("silver")};
  row.attributes = {kSurface};
  return row;
}

EntityKindDescription TerrainRow()
{
  EntityKindDescription row;
  row.tag = "terrain";
  row.word = "Terrain";
  row.description =
      "Uneven ground, from the one file that it holds; walls for two-dimensional engines, at the height of their "
      "planes.";
  row.role = EntityRole::kTerrain;
  row.mobility = Mobility::kNever;
  return row;
}

EntityKindDescription ChargingStation()
{
  EntityKindDescription row;
  row.tag = "charging_station";
  row.word = "ChargingStation";
  row.short_word = "station";
  row.description =
      "An area of the floor that charges the batteries of robots whose centre is over it. Either size or radius is "
      "given.";
  row.role = EntityRole::kPatch;
  row.mobility = Mobility::kNever;
  row.seen_by_cameras = true;
  row.colour = 0xf0c000;
  row.parameters = {AreaSizeParameter(),
                    AreaRadiusParameter(),
                    ColourParameter("#f0c000"),
                    PictureParameter(),
                    {kChargingPower, kNumber, "W", "10", "Power for each robot on it.", 0, 1e6},
                    {kChargingLimit, kNumber, "W", "0",
                     "Power for all robots on it together, which share it equally; 0: no limit.", 0, 1e6}};
  row.attributes = {kSurface,
                    {kChargingPower, 1, 10, "W for each robot on it"},
                    {kChargingLimit, 1, 0, "W for all robots on it together; 0: no limit"}};
  return row;
}

}  // namespace

ParameterSpec ControllerParameter()
{
  return {"controller", kText, "", "", "The id of its controller; empty: it has none and does nothing by itself."};
}

ParameterSpec MassParameter()
{
  return {"mass", kNumber, "kg", "0", "Its mass; 0: what the engine takes for its kind.", 0, 1e9};
}

ParameterSpec FrictionParameter()
{
  return ContactParameter("friction", "Coulomb coefficient where others touch it; by default that of the engine.", 100);
}

ParameterSpec RestitutionParameter()
{
  return ContactParameter(
      "restitution", "Part of the approach speed that a collision with it gives back; by default that of the engine.",
      1);
}

ParameterSpec GroundFrictionParameter()
{
  return ContactParameter("ground_friction",
                          "Coulomb coefficient of its base on the ground; by default that of the engine.", 100);
}

ParameterSpec GroundTorqueParameter()
{
  return {"ground_torque",
          kNumber,
          "N m",
          "",
          "Largest torque with which the ground resists its turning; by default that of even pressure under its base.",
          0,
          1e9};
}

ParameterSpec MovableParameter() { return {"movable", kBoolean, "", "false", "Whether physics can move it."}; }

ParameterSpec ColourParameter(std::string default_value)
{
  return {"colour", kColour, "", std::move(default_value), "Its colour."};
}

ParameterSpec IntensityParameter()
{
  return {"intensity", kNumber, "", "1", "Its strength; sensors scale their readings with it.", 0, 1e9};
}

ParameterSpec BoxSizeParameter()
{
  return Size({"size", kVector3, "m", std::nullopt, "Its extent along its own axes; the position is its centre."});
}

ParameterSpec RadiusParameter() { return Size({"radius", kNumber, "m", "0.1", "The radius of the cylinder."}); }

ParameterSpec HeightParameter() { return Size({"height", kNumber, "m", "0.1", "The height of the cylinder."}); }

ParameterSpec AreaSizeParameter()
{
  return Size({"size", kVector2, "m", "", "The sides of a rectangle around the position."});
}

ParameterSpec AreaRadiusParameter()
{
  return Size({"radius", kNumber, "m", "", "The radius of a disc around the position, instead of a size."});
}

ParameterSpec PictureParameter()
{
  return {"picture", kText, "", "",
          "A PNG or JPEG that is painted on its rectangle, seen through its colour (white if none is given). Relative "
          "to the experiment file."};
}

ParameterSpec MeshParameter()
{
  return {"mesh", kText, "", "",
          "A file that it is drawn as, stretched to fill its body: .glb, .gltf, .obj or .stl. It changes what is seen, "
          "not what collides, unless it is convex. Relative to the experiment file."};
}

ParameterSpec MeshOrientationParameter()
{
  return Angles({"mesh_orientation", kVector3, "degrees", "0, 0, 0",
                 "Turns the mesh in its body, about the fixed axes x, y and z in this order: \"90, 0, 0\" puts up one "
                 "whose y axis is up."});
}

ParameterSpec ConvexParameter()
{
  return {"convex", kBoolean, "", "false",
          "It collides as the convex hull of its mesh, stretched as that is, instead of as the box about it."};
}

ParameterSpec CornersParameter()
{
  return {
      "corners", kText, "", "",
      "\"x, y, z; x, y, z; …\": it collides as the convex hull of these points, which are stretched to fill its size."};
}

std::vector<EntityKindDescription> OwnKinds()
{
  std::vector<EntityKindDescription> rows = {Footbot(),       Handbot(),   Eyebot(),      Block(),
                                             CylindricPrey(), LightBulb(), SoundSource(), GroundPatch(),
                                             Hole(),          Wall(),      TerrainRow(),  ChargingStation()};
  for (EntityKindDescription& row : rows)
    if (row.short_word.empty()) row.short_word = row.tag;
  return rows;
}

}  // namespace swarmanoid
