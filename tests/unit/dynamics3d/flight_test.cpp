// Robots with rotors against closed forms.
#include <cmath>
#include <numeric>

#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/propelled.h"
#include "engine_worker/engines/dynamics3d/rotors.h"
#include "tests/unit/engines/test_quadrotor.h"

namespace swarmanoid
{
namespace
{

using dynamics3d::PropelledModel;
using dynamics3d::RotorSet;

const EntityKindDescription& Row() { return DescriptionOf(test::Quadrotor()); }
const Rotors& RotorsOfRow() { return *Row().propellers->rotors; }

// Returns the speed at which one rotor has a thrust: the root of x + y w + z w² = f.
double SpeedFor(double thrust)
{
  const Vector3& c = RotorsOfRow().thrust_of_speed;
  return (-c.y() + std::sqrt(c.y() * c.y() + 4 * c.z() * (thrust - c.x()))) / (2 * c.z());
}

// A quadrotor in the air, and its model.
class FlightWorld : public Dynamics3dTestWorld
{
public:
  explicit FlightWorld(const Vector3& position = {5, 5, 1})
      : quadrotor(Add(test::Quadrotor(), position, Quaternion::Identity(), Row().size))
  {
    Set("arena_walls", "false");
  }
  void Fly(double forward, double left, double up, double yaw_rate)
  {
    Command("eyebot_propellers", quadrotor, {forward, left, up, yaw_rate});
  }
  const PropelledModel& Model() const { return dynamic_cast<const PropelledModel&>(*engine->ModelForTest(quadrotor)); }
  // Returns the mean velocity of a tick.
  Vector3 VelocityOfNextTick()
  {
    const Vector3 before = Position(quadrotor);
    Tick();
    return (Position(quadrotor) - before) / 0.1;
  }

  std::uint32_t quadrotor;
};

TEST(RotorSet, ExertsTheThrustAndTheTorquesThatAreWantedOnceItsSpeedsHaveFollowed)
{
  for (const int count : {4, 6, 8})
  {
    Rotors row = RotorsOfRow();
    row.count = count;
    RotorSet rotors(row);
    const RotorSet::Wrench wanted{0.3, {1e-3, -5e-4, 2e-4}};
    RotorSet::Wrench exerted;
    for (int step = 0; step < 200; ++step) exerted = rotors.Advance(wanted, 0.005);
    EXPECT_NEAR(exerted.thrust, wanted.thrust, 1e-12) << count;
    EXPECT_LT((exerted.torque - wanted.torque).norm(), 1e-14) << count;
  }
}

TEST(RotorSet, ReachesTheRestOfAFirstOrderLagAfterItsTimeConstantUpAndDown)
{
  RotorSet rotors(RotorsOfRow());
  rotors.SpinFor(0.2);
  const double slow = SpeedFor(0.05);
  const double fast = SpeedFor(0.1);
  EXPECT_NEAR(rotors.Speeds()[0], slow, 1e-9);
  for (int step = 0; step < 4; ++step) rotors.Advance({0.4, Vector3::Zero()}, 0.005);  // 20 ms
  for (const double speed : rotors.Speeds()) EXPECT_NEAR(speed, fast - (fast - slow) * std::exp(-1), 1e-9);
  rotors.SpinFor(0.4);
  for (int step = 0; step < 8; ++step) rotors.Advance({0.2, Vector3::Zero()}, 0.005);  // 40 ms
  for (const double speed : rotors.Speeds()) EXPECT_NEAR(speed, slow + (fast - slow) * std::exp(-1), 1e-9);
}

TEST(RotorSet, WithoutALagExertsAtOnceAndNeverMoreThanItsRotorsCan)
{
  Rotors row = RotorsOfRow();
  row.spin_up_s = row.spin_down_s = 0;
  RotorSet rotors(row);
  EXPECT_NEAR(rotors.Advance({0.4, Vector3::Zero()}, 0.005).thrust, 0.4, 1e-12);
  EXPECT_NEAR(rotors.Advance({9, Vector3::Zero()}, 0.005).thrust, 4 * row.max_thrust_n, 1e-12);
  EXPECT_NEAR(rotors.Advance({-1, Vector3::Zero()}, 0.005).thrust, 0, 1e-12);
  // All that two rotors can do against the other two.
  const double most = 2 * row.max_thrust_n * row.torque_m;
  EXPECT_NEAR(rotors.Advance({2 * row.max_thrust_n, {0, 0, 1}}, 0.005).torque.z(), most, 1e-12);
}

// The first rotor stands ahead and to the left, and turns clockwise: its drag turns the robot counter-clockwise.
TEST(RotorSet, TurnsTheRobotAgainstItsRotors)
{
  Rotors row = RotorsOfRow();
  row.spin_up_s = row.spin_down_s = 0;
  RotorSet rotors(row);
  rotors.Advance({0.3, {0, 0, 1e-4}}, 0.005);
  EXPECT_GT(rotors.Speeds()[0], rotors.Speeds()[1]);
  EXPECT_NEAR(rotors.Speeds()[0], rotors.Speeds()[2], 1e-9);
  rotors.Advance({0.3, {1e-4, 0, 0}}, 0.005);
  EXPECT_GT(rotors.Speeds()[0], rotors.Speeds()[3]) << "a roll to the right lifts the left side";
}

TEST(Flight, HoversWithAThrustOfItsWeight)
{
  FlightWorld world;
  world.Run(50);
  EXPECT_LT((world.Position(world.quadrotor) - Vector3(5, 5, 1)).norm(), 1e-6);
  EXPECT_NEAR(world.Model().ThrustForTest(), Row().mass_kg * kGravity, 1e-6);
  EXPECT_NEAR(world.Model().RotorsForTest().SpeedSum(), 4 * SpeedFor(Row().mass_kg * kGravity / 4), 1e-3);
}

TEST(Flight, ClimbsAtTheCommandedRateWithTheThrustOfItsWeightAndItsDrag)
{
  FlightWorld world;
  world.experiment.arena_size.z() = 30;
  world.Fly(0, 0, 0.8, 0);
  world.Run(60);
  EXPECT_LT((world.VelocityOfNextTick() - Vector3(0, 0, 0.8)).norm(), 1e-3);
  const double drag = RotorsOfRow().drag.z() * world.Model().RotorsForTest().SpeedSum() * 0.8;
  EXPECT_NEAR(world.Model().ThrustForTest(), Row().mass_kg * kGravity + drag, 1e-5);
}

// The robot leans as far as it may, and the horizontal part of its drag, along its own axes, equals m a.
TEST(Flight, ReachesTheTerminalSpeedOfItsDragAtItsLargestTilt)
{
  FlightWorld world({0, 5, 100});
  world.experiment.arena_size = {2000, 10, 200};
  world.Fly(50, 0, 0, 0);
  world.Run(400);
  const Vector3 velocity = world.VelocityOfNextTick();
  const double across = Row().propellers->max_across_m_s2;
  const Quaternion attitude = world.Orientation(world.quadrotor);
  const Vector3 drag = attitude * world.Model().RotorsForTest().Drag(attitude.conjugate() * velocity);
  EXPECT_NEAR(-drag.x(), Row().mass_kg * across, 1e-3 * Row().mass_kg * across);
  // The same from the row alone, up to the force that the drag adds along z: m a = W v (kx cos² + kz sin²), where W are
  // the speeds for a thrust of m sqrt(g² + a²), and the tilt is that of the thrust.
  const double thrust = Row().mass_kg * std::hypot(kGravity, across);
  const double square = across * across / (kGravity * kGravity + across * across);
  const double along = RotorsOfRow().drag.x() * (1 - square) + RotorsOfRow().drag.z() * square;
  const double terminal = Row().mass_kg * across / (4 * SpeedFor(thrust / 4) * along);
  EXPECT_NEAR(velocity.x(), terminal, 0.06 * terminal);
}

TEST(Flight, TurnsAtTheCommandedYawRateAndStaysInPlace)
{
  FlightWorld world;
  world.Fly(0, 0, 0, 1.2);
  world.Run(30);
  const double yaw = world.Yaw(world.quadrotor);
  world.Run(10);
  EXPECT_NEAR(WrapAngle(world.Yaw(world.quadrotor) - yaw), 1.2, 1e-3);
  EXPECT_LT((world.Position(world.quadrotor) - Vector3(5, 5, 1)).norm(), 1e-3);
}

TEST(Flight, StartsFromTheGroundAndLandsThere)
{
  FlightWorld world({5, 5, 0});
  world.Fly(0, 0, 0.5, 0);
  world.Run(20);
  EXPECT_GT(world.Position(world.quadrotor).z(), 0.5);
  world.Fly(0, 0, -0.5, 0);
  world.Run(60);
  EXPECT_NEAR(world.Position(world.quadrotor).z(), 0, 2e-3);
  EXPECT_LT(world.Tilt(world.quadrotor), 0.01);
}

TEST(Flight, ContinuesFromASavedStateWithTheSameBits)
{
  FlightWorld one;
  FlightWorld other;
  for (FlightWorld* world : {&one, &other})
  {
    world->Fly(0.7, -0.3, 0.4, 1);
    world->Run(7);
  }
  other.ReplaceEngineBySavedState();
  for (FlightWorld* world : {&one, &other}) world->Run(20);
  EXPECT_EQ(one.Position(one.quadrotor), other.Position(other.quadrotor));
  EXPECT_EQ(one.Orientation(one.quadrotor).coeffs(), other.Orientation(other.quadrotor).coeffs());
}

// The place loop has no integral: the robot stands where m w² d = k W v, with the frequency w and the rotors' speeds W.
TEST(Flight, HoldsItsPlaceInAConstantWindUpToTheDragOverTheStiffnessOfItsPlaceLoop)
{
  FlightWorld world;
  world.experiment.wind = WindConfiguration{{0.8, -0.6, 0}, 0, 3};
  const auto eyebot = world.AddEyebot({2, 2, 1});
  world.Run(100);
  // Returns how far the centre of mass is away from its place, along the wind and up; the robot leans about it.
  const auto away = [&](std::uint32_t robot, const Vector3& place)
  {
    const Vector3 centre(0, 0, DescriptionOf(world.Space().GetEntity(robot).GetKind()).propellers->centre_of_mass_m);
    return Vector3(world.Position(robot) + world.Orientation(robot) * centre - place - centre);
  };
  const double rate = Row().propellers->place_rad_s;
  const double drag = RotorsOfRow().drag.x() * 4 * SpeedFor(Row().mass_kg * kGravity / 4);
  const double of_quadrotor = drag / (Row().mass_kg * rate * rate);
  EXPECT_LT((away(world.quadrotor, {5, 5, 1}) - of_quadrotor * Vector3(0.8, -0.6, 0)).norm(), 0.04 * of_quadrotor);
  const EntityKindDescription& row = DescriptionOf(EntityKind::kEyebot);
  const double of_eyebot = row.propellers->drag_in_wind.x() / (row.mass_kg * rate * rate);
  EXPECT_LT((away(eyebot, {2, 2, 1}) - of_eyebot * Vector3(0.8, -0.6, 0)).norm(), 0.01 * of_eyebot);
}

TEST(Flight, HasNoDragInAWindOfItsOwnVelocity)
{
  FlightWorld world;
  world.experiment.wind = WindConfiguration{{0.5, 0, 0}, 0, 3};
  world.Fly(0.5, 0, 0, 0);
  world.Run(60);
  EXPECT_NEAR(world.Tilt(world.quadrotor), 0, 1e-4);
  EXPECT_NEAR(world.VelocityOfNextTick().x(), 0.5, 1e-4);
}

TEST(Flight, ContinuesInGustsFromASavedStateWithTheSameBits)
{
  FlightWorld one;
  FlightWorld other;
  for (FlightWorld* world : {&one, &other})
  {
    world->experiment.wind = WindConfiguration{{1, 0.5, 0}, 5, 3};
    world->Fly(0.2, 0, 0, 0.5);
    world->Run(13);
  }
  other.ReplaceEngineBySavedState();
  for (FlightWorld* world : {&one, &other}) world->Run(20);
  EXPECT_EQ(one.Position(one.quadrotor), other.Position(other.quadrotor));
  EXPECT_GT((one.Position(one.quadrotor) - Vector3(5, 5, 1)).norm(), 0.1);
}

TEST(Flight, TouchesOthersWithABodyOfTheSizeOfItsRow)
{
  FlightWorld world({5, 5, 0.5});
  world.AddWall({5.5, 5, 0.5}, {0.1, 2, 1});
  world.Fly(0.3, 0, 0, 0);
  world.Run(60);
  EXPECT_NEAR(world.Position(world.quadrotor).x(), 5.45 - Row().size.x(), 0.01);
}

}  // namespace
}  // namespace swarmanoid
