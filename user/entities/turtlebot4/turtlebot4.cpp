// The TurtleBot 4 of Clearpath on iRobot's Create 3, a robot for research with a laser scanner: a kind of robot that a
// library adds to the simulator. Lengths are in metres. Sources of the figures:
// [1] github.com/turtlebot/turtlebot4-user-manual, overview/features.md, revision 0c075942: size, weight, fastest
//     speed with the safety features on (0.46 m/s without them), range of the scanner
// [2] github.com/iRobotEducation/create3_sim, irobot_create_common/irobot_create_description/urdf: create3.urdf.xacro,
//     revision 0676235d, wheel.urdf.xacro, revision 0aeab2f8, and sensors/ir_intensity.urdf.xacro, revision e027fe3b:
//     axle, wheels, places and range of the infrared and cliff sensors
// [3] github.com/turtlebot/turtlebot4, turtlebot4_description/urdf: standard/turtlebot4.urdf.xacro and
//     sensors/rplidar.urdf.xacro, revision 02fd7f40: places of scanner, camera and tower
// [4] github.com/iRobotEducation/create3_docs: docs/api/safety.md, revision 06486d0a: the speed to the millimetre, and
//     docs/hw/overview.md, revision 0fc030ac: six LEDs in a ring about the power button. Its place is ours.
// The laser scanner RPLIDAR A1M8 is the sensor range_scanner, at -0.04, 0, 0.193 [3] with a range of 12 m [1]. The body
// is a cylinder up to the top plate, so other scanners see it as wide as its base.
#include <utility>

#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kRadius = 0.342 / 2;
constexpr double kHeight = 0.351;
constexpr double kElevation = 0.0045;
constexpr double kBaseLink = 0.0642;  // the origin of the robot in [2], above the ground
constexpr double kWheelRadius = 0.03575;
constexpr double kWheelWidth = 0.015;
constexpr double kAxle = 0.233;
constexpr double kMass = 3.945;
constexpr double kMaxSpeed = 0.306;  // m/s
constexpr double kSensorHeight = kBaseLink - 0.007;
constexpr double kRange = 0.2;
constexpr double kShell = kBaseLink + 0.03;     // the top of the Create 3, where the shell of [3] begins
constexpr double kScanner = kShell + 0.098715;  // the plane of the beams

// From left to right.
std::vector<ProximityRing::Sensor> InfraredSensors()
{
  return {{{0.0399, 0.1488}, 1.309},   {{0.0990, 0.1180}, 0.873},   {{0.1396, 0.0651}, 0.436},  {{0.1540, 0}, 0},
          {{0.1396, -0.0651}, -0.436}, {{0.0990, -0.1180}, -0.873}, {{0.0399, -0.1488}, -1.309}};
}

std::vector<Vector2> PlacesOfLeds()
{
  std::vector<Vector2> places = PlacesOnCircle(6, 0.014, 0);
  for (Vector2& place : places) place.x() += 0.135;
  return places;
}

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

// The Create 3 with its bumper and windows of sensors, the shell with the scanner and the camera on it, and the plate
// on four standoffs.
std::vector<MeshPart> Mesh(const std::vector<Vector2>& leds)
{
  using Paint = MeshPart::Paint;
  constexpr double kDeck = kBaseLink + 0.08;  // the top of the shell
  std::vector<MeshPart> parts;
  for (const double side : {-1.0, 1.0})
  {
    const double y = side * kAxle / 2;
    parts.push_back(Rod({0, y - kWheelWidth / 2, kWheelRadius}, {0, y + kWheelWidth / 2, kWheelRadius}, kWheelRadius,
                        Paint::kRubber));
  }
  parts.push_back(Rod({0, 0, kElevation}, {0, 0, 0.02}, 0.155, Paint::kDark));
  parts.push_back(Rod({0, 0, 0.02}, {0, 0, kShell - 0.008}, 0.168, Paint::kBody));
  parts.push_back(Rod({0, 0, kShell - 0.008}, {0, 0, kShell}, 0.164, Paint::kShell));
  for (const ProximityRing::Sensor& sensor : InfraredSensors())
  {
    const SinCos direction = SinCosOf(sensor.direction);
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {0.163 * direction.cos, 0.163 * direction.sin, kSensorHeight},
                     .radius = 0.008,
                     .paint = Paint::kGlass});
  }
  parts.push_back(Rod({-0.02, 0, kShell}, {-0.02, 0, kDeck}, 0.12, Paint::kBody));
  // The scanner: its base with the motor behind, and the head that turns.
  parts.push_back({.from = {-0.0935, -0.0355, kDeck}, .to = {-0.0045, 0.0355, kDeck + 0.02}, .paint = Paint::kDark});
  parts.push_back(Rod({-0.04, 0, kDeck + 0.02}, {-0.04, 0, kScanner + 0.011}, 0.035, Paint::kDark));
  parts.push_back(
      {.from = {-0.0052, -0.022, kScanner - 0.008}, .to = {-0.003, 0.022, kScanner + 0.008}, .paint = Paint::kGlass});
  // The camera on its bracket, behind the scanner and above it.
  parts.push_back({.from = {-0.118, -0.02, kDeck}, .to = {-0.110, 0.02, kScanner + 0.055}, .paint = Paint::kMetal});
  parts.push_back(
      {.from = {-0.118, -0.02, kScanner + 0.038}, .to = {-0.072, 0.02, kScanner + 0.042}, .paint = Paint::kMetal});
  parts.push_back(
      {.from = {-0.080, -0.0485, kScanner + 0.042}, .to = {-0.058, 0.0485, kScanner + 0.070}, .paint = Paint::kDark});
  for (const auto& [x, y] : {std::pair(0.03063, 0.11431), std::pair(-0.07607, 0.09066)})
    for (const double side : {-1.0, 1.0})
      parts.push_back(Rod({x, side * y, kShell}, {x, side * y, kHeight - 0.004}, 0.006, Paint::kMetal));
  parts.push_back(Rod({-0.02, 0, kHeight - 0.004}, {-0.02, 0, kHeight}, 0.14, Paint::kShell));
  for (std::size_t led = 0; led < leds.size(); ++led)
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {leds[led].x(), leds[led].y(), kShell},
                     .radius = 0.006,
                     .paint = Paint::kLed,
                     .led = static_cast<int>(led)});
  return parts;
}

EntityKindDescription TurtleBot4()
{
  EntityKindDescription kind;
  kind.tag = "turtlebot4";
  kind.word = "TurtleBot4";
  kind.short_word = "turtlebot";
  kind.description =
      "A TurtleBot 4: a robot on two wheels with seven infrared sensors ahead, four that see holes in the floor, a "
      "ring "
      "of six LEDs, and a tower with a laser scanner (the sensor range_scanner). The position is the centre of its "
      "base.";
  kind.form = BodyForm::kCylinder;
  kind.size = {kRadius, kRadius, kHeight};
  kind.mass_kg = kMass;
  kind.colour = 0x2b2d30;
  kind.wheels = WheelDrive{kAxle, kWheelRadius, kMaxSpeed};
  kind.leds = LedLayout{PlacesOfLeds(), kShell, false};
  kind.proximity = ProximityRing{InfraredSensors(), kSensorHeight, kRange};
  // The cliff sensors, from left to right.
  kind.ground_points = {{0.06, 0.145}, {0.16, 0.045}, {0.16, -0.045}, {0.06, -0.145}};
  kind.mesh = Mesh(kind.leds->places);
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(turtlebot4, TurtleBot4())
