// The Pi-Puck, an e-puck with a Raspberry Pi on top: a kind of robot that a library adds to the simulator. Lengths in
// metres; figures: the simulator ARGoS's model of it (github.com/ilpincy/argos3, src/plugins/robots/pi-puck: body,
// wheels, masses simulator/dynamics3d_pipuck_model.cpp, LEDs and tag simulator/pipuck_entity.cpp, rangefinders
// control_interface/ci_pipuck_rangefinders_sensor.cpp, all of revision 13e3d6a6). These state no fastest speed: that is
// the e-puck's, https://cyberbotics.com/doc/guide/epuck, and so is the ring of LEDs.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kRadius = 0.0362;
constexpr double kHeight = 0.00125 + 2 * 0.069;
constexpr double kWheelRadius = 0.02125;
constexpr double kAxle = 2 * 0.0255;
constexpr double kMass = 0.001 + 2 * 0.1265;
constexpr double kMaxSpeed = 0.25;  // m/s
constexpr double kSensorHeight = 0.0333;
constexpr double kRange = 0.1;
constexpr double kTagHeight = 0.1385;
constexpr double kTagSide = 0.0235;

// Number 0 is to the right of the front; the others follow clockwise. Their directions are perpendicular to the axes
// about which the model turns them by a right angle: (0.218, 0.976), (0.730, 0.683), (1, 0), (0.630, -0.776) and their
// mirror images.
std::vector<ProximityRing::Sensor> Rangefinders()
{
  const auto angle = [](double x, double y) { return Atan2(y, x); };
  const double front = angle(0.976, -0.218), side = angle(0.683, -0.730), back = angle(-0.776, -0.630);
  return {{{0.0333, -0.0096}, front}, {{0.0234, -0.0264}, side}, {{0, -0.0350}, -kPi / 2},  {{-0.0280, -0.0212}, back},
          {{-0.0280, 0.0212}, -back}, {{0, 0.0350}, kPi / 2},    {{0.0234, 0.0264}, -side}, {{0.0333, 0.0096}, -front}};
}

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

// Wheels, an e-puck's body and ring, the boards above it on pillars, and the plate with the tag.
std::vector<MeshPart> Mesh(const std::vector<Vector2>& leds)
{
  using Paint = MeshPart::Paint;
  std::vector<MeshPart> parts;
  for (const double side : {-1.0, 1.0})
  {
    const double y = side * kAxle / 2;
    parts.push_back(Rod({0, y - 0.002, kWheelRadius}, {0, y + 0.002, kWheelRadius}, kWheelRadius, Paint::kRubber));
    parts.push_back(Rod({0, y - 0.003, kWheelRadius}, {0, y + 0.003, kWheelRadius}, 0.012, Paint::kMetal));
  }
  parts.push_back({.from = {-0.026, -0.021, 0.006}, .to = {0.026, 0.021, 0.030}, .paint = Paint::kShell});
  parts.push_back(Rod({0, 0, 0.029}, {0, 0, 0.034}, 0.0335, Paint::kBody));
  parts.push_back(Rod({0, 0, 0.034}, {0, 0, 0.038}, 0.0355, Paint::kShell));
  parts.push_back(Rod({0, 0, 0.050}, {0, 0, 0.0525}, 0.034, Paint::kBody));
  parts.push_back({.from = {-0.0325, -0.015, 0.065}, .to = {0.0325, 0.015, 0.068}, .paint = Paint::kBody});
  parts.push_back({.from = {-0.008, -0.008, 0.068}, .to = {0.008, 0.008, 0.071}, .paint = Paint::kDark});
  for (const double x : {-0.02, 0.02})
    for (const double y : {-0.02, 0.02})
      parts.push_back(Rod({x, y, 0.038}, {x, y, kTagHeight - 0.002}, 0.0015, Paint::kMetal));
  parts.push_back(Rod({0, 0, kTagHeight - 0.003}, {0, 0, kTagHeight - 0.001}, 0.030, Paint::kShell));
  parts.push_back({.from = {-kTagSide / 2, -kTagSide / 2, kTagHeight - 0.001},
                   .to = {kTagSide / 2, kTagSide / 2, kTagHeight},
                   .paint = Paint::kDark});
  parts.push_back({.from = {0.026, -0.005, 0.021}, .to = {0.0355, 0.005, 0.029}, .paint = Paint::kDark});
  for (std::size_t led = 0; led < leds.size(); ++led)
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {leds[led].x(), leds[led].y(), 0.0365},
                     .radius = 0.005,
                     .paint = Paint::kLed,
                     .led = static_cast<int>(led)});
  return parts;
}

EntityKindDescription PiPuck()
{
  EntityKindDescription kind;
  kind.tag = "pipuck";
  kind.word = "PiPuck";
  kind.description =
      "A Pi-Puck: an e-puck with a Raspberry Pi and a tag on top, eight rangefinders and eight LEDs. The position is "
      "the "
      "centre of its base.";
  kind.form = BodyForm::kCylinder;
  kind.size = {kRadius, kRadius, kHeight};
  kind.mass_kg = kMass;
  kind.colour = 0x1b7f3b;
  kind.wheels = WheelDrive{kAxle, kWheelRadius, kMaxSpeed};
  // The LEDs are numbered counter-clockwise from the front left, as all rings of LEDs here.
  kind.leds = LedLayout{PlacesOnCircle(8, 0.033, kPi / 8), 0.0365, false};
  kind.proximity = ProximityRing{Rangefinders(), kSensorHeight, kRange};
  kind.mesh = Mesh(kind.leds->places);
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(pipuck, PiPuck())
