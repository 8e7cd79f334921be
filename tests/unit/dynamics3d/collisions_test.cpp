// Collisions of upright bodies on the ground against closed forms, whatever part of a step is over when they touch.
#include <ode/ode.h>

#include <cmath>

#include "dynamics3d_test_world.h"

namespace swarmanoid
{
namespace
{

enum class Shape : std::uint8_t
{
  kDisc,
  kCylinder,
  kCube
};

constexpr const char* kNames[] = {"disc", "cylinder", "cube"};

struct Collision
{
  Shape shape = Shape::kDisc;
  int step_ms = 5;
  double offset = 0;       // m, of the second body's middle from the way of the first one
  double restitution = 1;  // of the second body
  double phase = 0;        // of the step in which they touch, 0 to 1
  double lean = 0;         // rad, of the first body
};

constexpr double kCollisionSpeed = 0.4;
constexpr double kMassA = 0.5, kMassB = 0.8;

double HalfWidth(Shape shape) { return shape == Shape::kCylinder ? 0.05 : 0.1; }
double Height(Shape shape) { return shape == Shape::kDisc ? 0.1 : shape == Shape::kCylinder ? 0.3 : 0.2; }

// A frictionless impulse along the normal takes (1 - e2) v2 / (2 k) of the energy. k is the sum of the inverse masses
// at the impulse. Two faces that meet keep their relative turn, so the impulse parts the offset by the masses.
double ExpectedEnergy(const Collision& collision)
{
  const double before = kMassA * kCollisionSpeed * kCollisionSpeed / 2;
  double inverse_mass = 1 / kMassA + 1 / kMassB;
  double approach = kCollisionSpeed;
  if (collision.shape == Shape::kCube)
  {
    const double width = 2 * HalfWidth(collision.shape);
    const double lever_a = collision.offset * kMassA / (kMassA + kMassB);
    const double lever_b = collision.offset - lever_a;
    inverse_mass += 6 / (width * width) * (lever_a * lever_a / kMassA + lever_b * lever_b / kMassB);
  }
  else
  {
    const double sine = collision.offset / (2 * HalfWidth(collision.shape));
    approach *= std::sqrt(1 - sine * sine);
  }
  const double e = collision.restitution;
  return 1 - (1 - e * e) * approach * approach / (2 * inverse_mass) / before;
}

double EnergyOf(dBodyID body)
{
  dMass mass;
  dBodyGetMass(body, &mass);
  const dReal* v = dBodyGetLinearVel(body);
  const dReal* w = dBodyGetAngularVel(body);
  return mass.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 +
         (mass.I[0] * (w[0] * w[0] + w[1] * w[1]) + mass.I[10] * w[2] * w[2]) / 2;
}

struct Outcome
{
  double energy = 0;    // of that before
  double vertical = 0;  // m/s, the largest speed after the collision
};

Outcome OutcomeOf(const Collision& collision)
{
  Dynamics3dTestWorld world("friction", "0", "step_ms", std::to_string(collision.step_ms));
  world.experiment.clock_tick_ms = collision.step_ms;
  const double half = HalfWidth(collision.shape);
  const double height = Height(collision.shape);
  const double step = 1e-3 * collision.step_ms;
  const double distance =
      collision.shape == Shape::kCube ? 2 * half : std::sqrt(4 * half * half - collision.offset * collision.offset);
  const double gap = kCollisionSpeed * step * (3 + collision.phase);
  const Quaternion lean(Eigen::AngleAxisd(collision.lean, Vector3(0, 1, 0)));
  const auto add = [&](double x, double y, double mass, const Quaternion& orientation)
  {
    if (collision.shape == Shape::kCube)
      return world.AddBlock({x, y, half}, {2 * half, 2 * half, 2 * half}, mass, orientation);
    return world.Add(EntityKind::kCylindricPrey, {x, y, 0}, orientation, {half, half, height}, mass);
  };
  const auto a = add(5 - distance - gap, 5, kMassA, lean);
  const auto b = add(5, 5 + collision.offset, kMassB, Quaternion::Identity());
  for (const auto entity : {a, b})
    world.experiment.entities[entity].tree =
        test::TreeOf({{"restitution", entity == a ? "0" : std::to_string(collision.restitution)}});
  world.Start();
  const auto body = [&](int number) { return world.engine->WorldForTest().Body(number); };
  dBodySetLinearVel(body(0), kCollisionSpeed, 0, 0);
  const double before = EnergyOf(body(0));
  Outcome outcome;
  for (int tick = 0; tick < 30; ++tick)
  {
    world.Tick();
    if (dBodyGetLinearVel(body(1))[0] == 0) continue;
    for (const int number : {0, 1})
      outcome.vertical = std::max(outcome.vertical, std::abs(dBodyGetLinearVel(body(number))[2]));
  }
  outcome.energy = (EnergyOf(body(0)) + EnergyOf(body(1))) / before;
  return outcome;
}

TEST(Dynamics3dCollisions, UprightBodiesKeepTheEnergyThatTheirRestitutionLeavesAtEachPhaseOfAStep)
{
  constexpr int kPhases = 40;
  constexpr double kLean = 3.5e-4;  // 0.02 degrees
  for (const Shape shape : {Shape::kDisc, Shape::kCylinder, Shape::kCube})
    for (const int step_ms : {5, 2, 1})
      for (const double offset : {0.0, 0.5, 1.0})
        for (const double restitution : {1.0, 0.5})
          for (int k = 0; k < kPhases; ++k)
          {
            const Collision collision{.shape = shape,
                                      .step_ms = step_ms,
                                      .offset = offset * HalfWidth(shape),
                                      .restitution = restitution,
                                      .phase = (k + 0.01) / kPhases,
                                      .lean = kLean * (k % 3 - 1)};
            const Outcome outcome = OutcomeOf(collision);
            const std::string name = std::string(kNames[static_cast<int>(shape)]) + ", " + std::to_string(step_ms) +
                                     " ms, offset " + std::to_string(collision.offset) +
                                     " m, e = " + std::to_string(restitution) + ", phase " +
                                     std::to_string(collision.phase) + ", lean " + std::to_string(collision.lean);
            EXPECT_NEAR(outcome.energy, ExpectedEnergy(collision), 0.01) << name;
            EXPECT_LT(outcome.vertical, 2e-3) << name;
          }
}

}  // namespace
}  // namespace swarmanoid
