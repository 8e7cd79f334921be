// The Khepera IV of K-Team, a wheeled robot for research: a kind of robot that a library adds to the simulator. Lengths
// in metres; figures: the simulator ARGoS's model of it (github.com/ilpincy/argos3-kheperaiv,
// src/plugins/robots/kheperaiv/ simulator: kheperaiv_measures.cpp, revision 56357d6e, and the mass of
// dynamics2d_kheperaiv_model.cpp, revision da9234f3); the numbering of the proximity sensors and the fastest speed of
// the robot in use: https://the.swarming.buzz/wiki/doku.php?id=buzz_kh4&rev=1521591124.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kRadius = 0.0704;
constexpr double kElevation = 0.0047;  // height of the body above the ground
constexpr double kTop = kElevation + 0.053;
constexpr double kWheelRadius = 0.021;
constexpr double kAxle = 0.1054;
constexpr double kMass = 0.4;
constexpr double kMaxSpeed = 0.2;  // m/s
constexpr double kSensorHeight = 0.0145;
constexpr double kRange = 0.12;

// Number 0 looks ahead; the others follow counter-clockwise.
std::vector<ProximityRing::Sensor> InfraredSensors()
{
  std::vector<ProximityRing::Sensor> sensors;
  const std::vector<Vector2> places = PlacesOnCircle(8, kRadius, 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    sensors.push_back({places[i], WrapAngle(static_cast<double>(i) * kPi / 4)});
  return sensors;
}

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

// Wheels in a round body of two shells, the windows of the sensors between them, the camera in front, and the LEDs on
// top.
std::vector<MeshPart> Mesh(const std::vector<Vector2>& leds)
{
  using Paint = MeshPart::Paint;
  std::vector<MeshPart> parts;
  for (const double side : {-1.0, 1.0})
  {
    const double y = side * kAxle / 2;
    parts.push_back(Rod({0, y - 0.004, kWheelRadius}, {0, y + 0.004, kWheelRadius}, kWheelRadius, Paint::kRubber));
  }
  parts.push_back(Rod({0, 0, kElevation}, {0, 0, 0.010}, 0.066, Paint::kDark));
  parts.push_back(Rod({0, 0, 0.010}, {0, 0, 0.019}, 0.069, Paint::kGlass));
  parts.push_back(Rod({0, 0, 0.019}, {0, 0, 0.048}, kRadius, Paint::kBody));
  parts.push_back(Rod({0, 0, 0.048}, {0, 0, kTop - 0.002}, 0.068, Paint::kShell));
  parts.push_back({.from = {-0.030, -0.012, kTop - 0.002}, .to = {0.020, 0.012, kTop}, .paint = Paint::kDark});
  parts.push_back(Rod({0.064, 0, 0.034}, {0.0725, 0, 0.034}, 0.006, Paint::kDark));
  for (std::size_t led = 0; led < leds.size(); ++led)
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {leds[led].x(), leds[led].y(), kTop - 0.002},
                     .radius = 0.006,
                     .paint = Paint::kLed,
                     .led = static_cast<int>(led)});
  return parts;
}

EntityKindDescription KheperaIV()
{
  EntityKindDescription kind;
  kind.tag = "khepera_iv";
  kind.word = "KheperaIV";
  kind.short_word = "khepera";
  kind.description =
      "A Khepera IV: a robot on two wheels with eight infrared sensors around it, four that see the floor, and three "
      "LEDs on top. The position is the centre of its base.";
  kind.form = BodyForm::kCylinder;
  kind.size = {kRadius, kRadius, kTop};
  kind.mass_kg = kMass;
  kind.colour = 0x37474f;
  kind.wheels = WheelDrive{kAxle, kWheelRadius, kMaxSpeed};
  kind.leds = LedLayout{{{0.04, 0.025}, {-0.05, 0}, {0.04, -0.025}}, kTop, false};
  kind.proximity = ProximityRing{InfraredSensors(), kSensorHeight, kRange};
  kind.ground_points = {{0.0614, 0.01}, {0.0206, 0.059}, {0.0206, -0.059}, {0.0614, -0.01}};
  kind.mesh = Mesh(kind.leds->places);
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(khepera_iv, KheperaIV())
