// The Crazyflie 2, a small quadrotor: a kind of robot that a library adds to the simulator. Lengths are in metres.
// Sources of the figures:
// [1] J. Förster, "System Identification of the Crazyflie 2.0 Nano Quadrocopter", bachelor thesis, ETH Zurich 2015,
//     https://doi.org/10.3929/ethz-b-000214143: arm, inertia (its largest mixed term, 1.8e-6, is left out), thrust,
//     torque and speed of a rotor by its command, drag
// [2] Bitcraze, https://www.bitcraze.io/products/old-products/crazyflie-2-0/: 27 g, 92 x 92 x 29 mm
// [3] CrazyS, github.com/gsilano/CrazyS, rotors_description/urdf/crazyflie2.xacro, revision 02514919: radius and height
//     of the rotors, time constants of the motors
// [4] Bitcraze's decks: twelve LEDs in a ring below, and the Multi-ranger with four rangefinders up to 4 m
// The limits and frequencies of the autopilot are ours.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kMass = 0.027;
constexpr double kArm = 0.046;
constexpr double kHeight = 0.029;
constexpr double kRotorRadius = 0.0225;
constexpr double kRotorHeight = 0.024;
constexpr double kRadius = kArm + kRotorRadius;

// A rotor's command c, 0 to 65535, gives the thrust p0 + p1 c + p2 c² (N) and the speed w0 + w1 c (rad/s) [1].
constexpr double kP0 = 5.484560e-4, kP1 = 1.032633e-6, kP2 = 2.130295e-11;
constexpr double kW0 = 380.8359, kW1 = 0.04076521;
constexpr double kMostCommand = 65535;

Rotors RotorsOfCrazyflie()
{
  Rotors rotors;
  rotors.reach_m = kArm;
  rotors.max_thrust_n = kP0 + kP1 * kMostCommand + kP2 * kMostCommand * kMostCommand;
  rotors.torque_m = 0.005964552;
  // c = (w - w0) / w1 in the thrust by the command.
  const double square = kP2 / (kW1 * kW1);
  const double slope = kP1 / kW1;
  rotors.thrust_of_speed = {kP0 - slope * kW0 + square * kW0 * kW0, slope - 2 * square * kW0, square};
  rotors.spin_up_s = 0.0125;
  rotors.spin_down_s = 0.025;
  rotors.drag = {9.1785e-7, 9.1785e-7, 10.311e-7};
  return rotors;
}

MeshPart Rod(const Vector3& from, const Vector3& to, double radius, MeshPart::Paint paint)
{
  return {.form = MeshPart::Form::kRod, .from = from, .to = to, .radius = radius, .paint = paint};
}

// The board with its arms, the battery above, motors and rotors at the ends of the arms, and the ring of LEDs below.
std::vector<MeshPart> Mesh(const std::vector<Vector2>& leds)
{
  using Paint = MeshPart::Paint;
  std::vector<MeshPart> parts;
  parts.push_back({.from = {-0.017, -0.015, 0.010}, .to = {0.017, 0.015, 0.012}, .paint = Paint::kDark});
  parts.push_back({.from = {-0.015, -0.010, 0.013}, .to = {0.015, 0.010, 0.020}, .paint = Paint::kShell});
  parts.push_back({.from = {0.014, -0.004, 0.012}, .to = {0.022, 0.004, 0.015}, .paint = Paint::kBody});
  for (const Vector2& direction : PlacesOnCircle(4, 1, kPi / 4))
  {
    const Vector2 end = kArm * direction;
    const auto at = [&](double z) { return Vector3(end.x(), end.y(), z); };
    parts.push_back(Rod({0, 0, 0.011}, at(0.011), 0.003, Paint::kDark));
    parts.push_back(Rod(at(0), at(kRotorHeight - 0.001), 0.0035, Paint::kMetal));
    // The front rotors have the colour of the body.
    parts.push_back(Rod(at(kRotorHeight), at(kRotorHeight + 0.001), kRotorRadius,
                        direction.x() > 0 ? Paint::kBody : Paint::kShell));
  }
  for (std::size_t led = 0; led < leds.size(); ++led)
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {leds[led].x(), leds[led].y(), 0.007},
                     .radius = 0.0035,
                     .paint = Paint::kLed,
                     .led = static_cast<int>(led)});
  return parts;
}

EntityKindDescription Crazyflie()
{
  EntityKindDescription kind;
  kind.tag = "crazyflie";
  kind.word = "Crazyflie";
  kind.description =
      "A Crazyflie 2: a quadrotor of 27 g with four rangefinders and a ring of twelve LEDs. The position is the centre "
      "of its base.";
  kind.form = BodyForm::kCylinder;
  kind.size = {kRadius, kRadius, kHeight};
  kind.mass_kg = kMass;
  kind.colour = 0xd9822b;
  Propellers propellers;
  propellers.inertia_kg_m2 = {16.571710e-6, 16.655602e-6, 29.261652e-6};
  propellers.centre_of_mass_m = kHeight / 2;
  propellers.max_yaw_rate_rad_s = 2;
  propellers.max_across_m_s2 = 3.5;  // a tilt of 20 degrees
  propellers.max_upward_m_s2 = 5;
  propellers.plane_force_n = kMass * propellers.max_across_m_s2;
  propellers.plane_torque_n_m = 1e-3;
  propellers.rotors = RotorsOfCrazyflie();
  kind.propellers = propellers;
  kind.leds = LedLayout{PlacesOnCircle(12, 0.018, kPi / 12), 0.007, false};
  kind.proximity =
      ProximityRing{{{{0.02, 0}, 0}, {{0, 0.02}, kPi / 2}, {{-0.02, 0}, kPi}, {{0, -0.02}, -kPi / 2}}, 0.014, 4};
  kind.attributes = {{"message", 3, 0,
                      "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                      AttributeValue::kBytes}};
  kind.mesh = Mesh(kind.leds->places);
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(crazyflie, Crazyflie())
