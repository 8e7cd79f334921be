// The Thymio II of Mobsya, a robot for teaching with its wheels at the back: a kind of robot that a library adds to the
// simulator. The position is the middle of its axle, on the ground. Lengths are in metres. Sources of the figures:
// [1] github.com/jeguzzi/ros-thymio, thymio_description/urdf: base.urdf.xacro, revision 374ff87c, and wheel.urdf.xacro,
//     revision f2a3cedd: axle, wheels, masses, places, directions and range of the sensors
// [2] Enki, github.com/enki-community/enki, enki/robots/thymio2/Thymio2.cpp, revision 02a960df: the outline seen from
//     above, an arc of 80 mm about the axle's middle between straight sides
// [3] Webots, https://cyberbotics.com/doc/guide/thymio2: height, fastest speed; its projects/robots/mobsya/thymio/
//     protos/Thymio2.proto, revision 08f0a117: LEDs and buttons
// In dynamics3d, and for everything that senses it, the body is the hull of [2]. In engines of the plane it is a box
// about the axle, which reaches 80 mm to the back instead of 30 mm.
#include <cmath>

#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kFront = 0.08;  // the radius of the arc
constexpr double kBack = -0.03;
constexpr double kHalfWidth = 0.055;
constexpr double kHeight = 0.053;
constexpr double kWheelRadius = 0.022;
constexpr double kWheelWidth = 0.015;
constexpr double kAxle = 0.0935;
constexpr double kMass = 0.2 + 2 * 0.024;  // of the body and both wheels
constexpr double kMaxSpeed = 0.2;          // m/s
constexpr double kSensorHeight = 0.035;
constexpr double kRange = 0.12;
constexpr double kLedHeight = 0.0213;  // of the two at the front
constexpr double kButtonsAt = 0.0489;

// Numbers 0 to 4 look ahead, from left to right. Number 5 looks back at the left and 6 at the right.
std::vector<ProximityRing::Sensor> ProximitySensors()
{
  return {{{0.063, 0.0493}, 0.66323},    {{0.0756, 0.0261}, 0.33161},  {{0.08, 0}, 0},
          {{0.0756, -0.0261}, -0.33161}, {{0.063, -0.0493}, -0.66323}, {{-0.03, 0.0305}, kPi},
          {{-0.03, -0.0305}, kPi}};
}

// Returns x of the front of the body at a distance y from its middle line.
double FrontAt(double y) { return std::sqrt(kFront * kFront - y * y); }

// The body: an upright prism over the outline.
std::vector<Vector3> Corners()
{
  constexpr int kOfArc = 11;
  std::vector<Vector3> corners;
  for (const double z : {0.0, kHeight})
  {
    for (int i = 0; i < kOfArc; ++i)
    {
      const double y = kHalfWidth * (2.0 * i / (kOfArc - 1) - 1);
      corners.emplace_back(FrontAt(y), y, z);
    }
    corners.emplace_back(kBack, kHalfWidth, z);
    corners.emplace_back(kBack, -kHalfWidth, z);
  }
  return corners;
}

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

MeshPart Led(const Vector3& place, double radius, int led)
{
  return {.form = MeshPart::Form::kBall, .from = place, .radius = radius, .paint = MeshPart::Paint::kLed, .led = led};
}

// A white body in strips along the arc of its front, which is narrow between the wheels below its upper shell; the
// windows of the sensors, the buttons, and the LEDs at their own heights.
std::vector<MeshPart> Mesh()
{
  using Paint = MeshPart::Paint;
  constexpr double kElevation = 0.006;
  constexpr double kUpperShell = 0.046;
  constexpr double kBehindArc = 0.025;                          // the wheels are further back
  constexpr double kBetweenWheels = (kAxle - kWheelWidth) / 2;  // half of the width between them
  constexpr int kStrips = 22;
  std::vector<MeshPart> parts;
  for (int strip = 0; strip < kStrips; ++strip)
  {
    const double begin = kHalfWidth * (2.0 * strip / kStrips - 1);
    const double end = kHalfWidth * (2.0 * (strip + 1) / kStrips - 1);
    parts.push_back({.from = {kBehindArc, begin, kElevation}, .to = {FrontAt((begin + end) / 2), end, kHeight}});
  }
  parts.push_back({.from = {kBack, -kHalfWidth, kUpperShell}, .to = {kBehindArc, kHalfWidth, kHeight}});
  parts.push_back({.from = {kBack, -kBetweenWheels, kElevation}, .to = {kBehindArc, kBetweenWheels, kUpperShell}});
  for (const double side : {-1.0, 1.0})
  {
    const double y = side * kAxle / 2;
    parts.push_back(Rod({0, y - kWheelWidth / 2, kWheelRadius}, {0, y + kWheelWidth / 2, kWheelRadius}, kWheelRadius,
                        Paint::kRubber));
  }
  for (const ProximityRing::Sensor& sensor : ProximitySensors())
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {sensor.place.x(), sensor.place.y(), kSensorHeight},
                     .radius = 0.003,
                     .paint = Paint::kDark});
  for (const Vector2& button : PlacesOnCircle(4, 0.015, 0))
    parts.push_back(Rod({kButtonsAt + button.x(), button.y(), kHeight},
                        {kButtonsAt + button.x(), button.y(), kHeight + 0.001}, 0.005, Paint::kDark));
  parts.push_back(Led({0.0459, kHalfWidth - 0.003, kLedHeight}, 0.006, 0));
  for (const double side : {-1.0, 1.0}) parts.push_back(Led({0, side * 0.0319, kHeight - 0.007}, 0.009, 1));
  parts.push_back(Led({0.0459, -kHalfWidth + 0.003, kLedHeight}, 0.006, 2));
  return parts;
}

EntityKindDescription ThymioII()
{
  EntityKindDescription kind;
  kind.tag = "thymio_ii";
  kind.word = "ThymioII";
  kind.short_word = "thymio";
  kind.description =
      "A Thymio II: a robot with two wheels at its back, five proximity sensors ahead and two behind, two that see the "
      "floor, and three coloured LEDs. The position is the middle of its axle, on the ground.";
  kind.form = BodyForm::kBox;
  kind.size = {2 * kFront, 2 * kHalfWidth, kHeight};
  kind.corners = Corners();
  kind.mass_kg = kMass;
  kind.colour = 0xf4f4f0;
  kind.wheels = WheelDrive{kAxle, kWheelRadius, kMaxSpeed};
  // Below at the left, above, and below at the right. A row has one height for all.
  kind.leds = LedLayout{{{0.0459, kHalfWidth}, {0, 0}, {0.0459, -kHalfWidth}}, kHeight, false};
  kind.proximity = ProximityRing{ProximitySensors(), kSensorHeight, kRange};
  kind.ground_points = {{0.07157, 0.01155}, {0.07157, -0.01155}};
  kind.mesh = Mesh();
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(thymio_ii, ThymioII())
