// The e-puck, a small wheeled robot for teaching, and its successor, the e-puck2: kinds of robots that a library adds
// to the simulator. These rows have all that the simulator knows about them. Lengths are in metres. The figures are
// from https://cyberbotics.com/doc/guide/epuck (the page of Webots, a simulator with a model of it), tables "E-puck
// features", "E-puck characteristics" and "Devices orientations". Section "e-puck2" has the mass and the speed of the
// e-puck2; the place of its time-of-flight sensor is from projects/robots/gctronic/e-puck/protos/E-puck.proto of
// Webots, revision 01310723.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kRadius = 0.0355;
constexpr double kHeight = 0.05;
constexpr double kWheelRadius = 0.0205;
constexpr double kAxle = 0.052;
constexpr double kSensorHeight = 0.033;

// x is to the front, y to the left; directions are counter-clockwise from the front. Number 0 is to the right of the
// front; the others follow clockwise.
std::vector<ProximityRing::Sensor> ProximitySensors()
{
  return {{{0.030, -0.010}, 1.27 - kPi / 2},      {{0.022, -0.025}, 0.77 - kPi / 2}, {{0, -0.031}, -kPi / 2},
          {{-0.030, -0.015}, 5.21 - 5 * kPi / 2}, {{-0.030, 0.015}, 4.21 - kPi / 2}, {{0, 0.031}, kPi / 2},
          {{0.022, 0.025}, 2.37 - kPi / 2},       {{0.030, 0.010}, 1.87 - kPi / 2}};
}

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

// The parts of both: wheels, a lower body with the battery, a green board, a ring with the LEDs, and the camera.
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
  parts.push_back({.from = {-0.026, -0.022, 0.006}, .to = {0.026, 0.022, 0.030}, .paint = Paint::kShell});
  parts.push_back(Rod({0, 0, 0.029}, {0, 0, 0.034}, 0.0335, Paint::kBody));
  parts.push_back(Rod({0, 0, 0.034}, {0, 0, 0.038}, kRadius, Paint::kShell));
  parts.push_back({.from = {0.024, -0.005, 0.021}, .to = {0.034, 0.005, 0.029}, .paint = Paint::kDark});
  for (std::size_t led = 0; led < leds.size(); ++led)
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {leds[led].x(), leds[led].y(), 0.0365},
                     .radius = 0.005,
                     .paint = Paint::kLed,
                     .led = static_cast<int>(led)});
  return parts;
}

EntityKindDescription EPuck()
{
  EntityKindDescription kind;
  kind.tag = "epuck";
  kind.word = "EPuck";
  kind.description =
      "An e-puck: a small robot on two wheels with eight proximity sensors and eight LEDs. The position "
      "is the centre of its base.";
  kind.form = BodyForm::kCylinder;
  kind.size = {kRadius, kRadius, kHeight};
  kind.mass_kg = 0.15;
  kind.colour = 0x2f9e44;
  kind.wheels = WheelDrive{kAxle, kWheelRadius, 0.25};
  // The LEDs are numbered counter-clockwise from the front left, as all rings of LEDs here.
  kind.leds = LedLayout{PlacesOnCircle(8, 0.033, kPi / 8), 0.0365, false};
  kind.proximity = ProximityRing{ProximitySensors(), kSensorHeight, 0.04};
  // The ground sensors are those of the extension with three sensors below the front.
  kind.ground_points = {{0.03, 0.01}, {0.03, 0}, {0.03, -0.01}};
  kind.mesh = Mesh(kind.leds->places);
  // The upper board with the selector.
  kind.mesh.push_back(Rod({0, 0, 0.038}, {0, 0, 0.046}, 0.030, MeshPart::Paint::kBody));
  kind.mesh.push_back(Rod({-0.012, 0, 0.046}, {-0.012, 0, kHeight}, 0.008, MeshPart::Paint::kDark));
  return kind;
}

// The same body without the upper board. Its time-of-flight sensor is the sensor range_scanner with one beam, at
// 0.034, -0.0018, 0.033 with a range of 2 m. Its four microphones together are one of the sensors microphone.
EntityKindDescription EPuck2()
{
  constexpr double kStepsInTurn = 1000, kStepsInSecond = 1200;
  constexpr double kTop = 0.045;
  EntityKindDescription kind = EPuck();
  kind.tag = "epuck2";
  kind.word = "EPuck2";
  kind.description =
      "An e-puck2: the successor of the e-puck, with the same sensors and LEDs, and a distance sensor ahead (the "
      "sensor "
      "range_scanner). The position is the centre of its base.";
  kind.size.z() = kTop;
  kind.mass_kg = 0.13;
  kind.colour = 0x237a3b;
  kind.wheels->max_speed_m_s = kStepsInSecond / kStepsInTurn * 2 * kPi * kWheelRadius;
  kind.mesh = Mesh(kind.leds->places);
  kind.mesh.push_back(Rod({0, 0, 0.038}, {0, 0, 0.0395}, 0.034, MeshPart::Paint::kBody));
  kind.mesh.push_back({.from = {-0.012, -0.015, 0.0395}, .to = {0.010, -0.009, kTop}, .paint = MeshPart::Paint::kDark});
  kind.mesh.push_back(
      {.from = {0.033, -0.004, 0.031}, .to = {0.0352, 0.0004, 0.035}, .paint = MeshPart::Paint::kGlass});
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(epuck, EPuck())
REGISTER_ENTITY_KIND(epuck2, EPuck2())
