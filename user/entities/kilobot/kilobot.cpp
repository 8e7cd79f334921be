// The Kilobot, a robot of 33 mm on three stiff legs that two vibration motors drive, for swarms of hundreds: a kind of
// robot that a library adds to the simulator. Lengths in metres; figures: the simulator ARGoS's model of it
// (github.com/ilpincy/argos3-kilobot, revision c6331a74, src/plugins/robots/kilobot/simulator/kilobot_measures.h; the
// fastest motor from control_interface/ci_kilobot_controller.cpp, revision 000faf67). The robot itself: M. Rubenstein,
// C. Ahler, R. Nagpal, "Kilobot: A low cost scalable robot system for collective behaviors", ICRA 2012.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kRadius = 0.0165;
constexpr double kPinHeight = 0.0217;  // height of the legs
constexpr double kHeight = kPinHeight + 0.0127;
constexpr double kPinRadius = 0.0007;
constexpr double kInterpinDistance = 0.025;  // between the two driving legs
constexpr double kFrontPin = 0.025;          // from the line between them to the front leg
constexpr double kEccentricity = 0.0092;     // from the line between them to the middle of the body
// It slides on its legs and has no wheels. This is the radius of a leg in a model with two wheels.
constexpr double kLegAsWheel = 0.001;
constexpr double kMaxSpeed = 0.03;  // m/s

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

// Legs, the board that is its chassis, the battery on it, a motor at each side, and the LED.
std::vector<MeshPart> Mesh(const Vector2& led)
{
  using Paint = MeshPart::Paint;
  std::vector<MeshPart> parts;
  const auto leg = [&](double x, double y) {
    parts.push_back(Rod({x, y, 0}, {x, y, kPinHeight}, kPinRadius, Paint::kMetal));
  };
  leg(-kEccentricity, kInterpinDistance / 2);
  leg(-kEccentricity, -kInterpinDistance / 2);
  leg(kFrontPin - kEccentricity - kPinRadius, 0);
  parts.push_back(Rod({0, 0, kPinHeight}, {0, 0, kPinHeight + 0.0016}, kRadius, Paint::kBody));
  parts.push_back(Rod({0, 0, kPinHeight + 0.0016}, {0, 0, kPinHeight + 0.0085}, 0.0105, Paint::kMetal));
  for (const double side : {-1.0, 1.0})
    parts.push_back(Rod({-0.004, side * 0.0135, kPinHeight + 0.0016}, {-0.004, side * 0.0135, kPinHeight + 0.0046},
                        0.003, Paint::kDark));
  parts.push_back({.form = MeshPart::Form::kBall,
                   .from = {led.x(), led.y(), kHeight - 0.0035},
                   .radius = 0.0035,
                   .paint = Paint::kLed});
  return parts;
}

EntityKindDescription Kilobot()
{
  EntityKindDescription kind;
  kind.tag = "kilobot";
  kind.word = "Kilobot";
  kind.description =
      "A Kilobot: a robot of 33 mm on three legs, with an LED and messages of a few bytes to its neighbours. The "
      "position is the centre of its base. It slides on a plane; give it to an engine of planes.";
  kind.form = BodyForm::kCylinder;
  kind.size = {kRadius, kRadius, kHeight};
  kind.mass_kg = 0.01;
  kind.colour = 0x37474f;
  kind.wheels = WheelDrive{kInterpinDistance, kLegAsWheel, kMaxSpeed};
  const SinCos angle = SinCosOf(kPi / 6);
  const Vector2 led(kRadius / 2 * angle.cos, kRadius / 2 * angle.sin);
  kind.leds = LedLayout{{led}, kHeight, false};
  kind.attributes = {{"message", 3, 0, "the bytes that it sends", AttributeValue::kBytes}};
  kind.mesh = Mesh(led);
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(kilobot, Kilobot())
