// Hosts that get only the entities near their robots sense and command the same as hosts that get all.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/math/random.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/space/space.h"
#include "controller_host/controller_host.h"
#include "idl/robot_status.h"
#include "space_server/near_entities.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

constexpr unsigned kHosts = 3;
constexpr std::uint32_t kRobots = 150;
constexpr double kSide = 45;  // m

// Shines and sends by what it senses, so that an error spreads.
class Shouter : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  bool HasState() const override { return true; }  // that it has none
  void ControlStep() override
  {
    const auto byte = static_cast<std::uint8_t>(StreamName(GetRobot()->GetId()) >> GetRobot()->GetTick() % 40);
    GetRobot()->Actuator<CCI_LedRingActuator>("led_ring").SetAllColours(byte < 128 ? 0U : byte * 0x10101U);
    GetRobot()->Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage({byte, 7});
  }
};

REGISTER_CONTROLLER(Shouter, "surroundings_test")

struct Sensor
{
  std::string type, implementation;
};

Experiment Swarm(const Sensor& sensor, std::mt19937& random)
{
  DescribeBuiltins();
  RegisterBuiltinDevices();
  Experiment experiment;
  experiment.arena_size = {kSide, kSide, 2};
  test::AddController(experiment, "surroundings_test", "c", {"generic_led_ring", "generic_range_and_bearing"})
      .sensors = {test::Device(sensor.implementation)};
  experiment.engines.resize(1);
  experiment.engines[0].tag = "kinematics2d";
  std::uniform_real_distribution<double> place(0.3, kSide - 0.3);
  for (std::uint32_t k = 0; k < kRobots; ++k)
  {
    // Some are things of another size that robots see and bump into.
    const bool is_prey = k % 10 == 9;
    EntityConfiguration entity = test::Entity(is_prey ? EntityKind::kCylindricPrey : EntityKind::kFootbot,
                                              "e" + std::to_string(k), {place(random), place(random), 0});
    if (is_prey) entity.size = {1.2, 1.2, 0.3};
    if (!is_prey) entity.controller = "c";
    // Half of them close together: there is something to sense.
    if (k % 2 == 0) entity.pose.position = {place(random) / 6 + (k % 3) * 15, place(random) / 6 + (k % 5) * 8, 0};
    test::Add(experiment, entity);
  }
  return experiment;
}

// A host that gets all entities or a part.
struct Host
{
  Host(const Experiment& experiment, const Assignment& assignment, std::size_t number)
      : space(experiment), role(space, assignment, number)
  {
  }
  CSwarmanoidSpace space;
  ControllerHost role;
  std::vector<std::uint32_t> near;
};

std::unique_ptr<Host> Successor(const Experiment& experiment, const Assignment& assignment, std::size_t number,
                                const Host& before)
{
  auto host = std::make_unique<Host>(experiment, assignment, number);
  SpaceSnapshot snapshot;
  snapshot.tick = before.space.GetTick();
  before.space.WritePoses(snapshot.poses);
  snapshot.attributes.assign(before.space.Attributes().Values().begin(), before.space.Attributes().Values().end());
  host->space.Apply(snapshot);
  ByteWriter saved;
  before.role.SaveState(saved);
  ByteReader state(saved.Bytes());
  host->role.LoadState(state);
  return host;
}

class Swarms : public testing::TestWithParam<Sensor>
{
};

std::vector<double> ReadingsOf(const ControllerHost& role, const std::vector<std::uint32_t>& robots)
{
  std::vector<double> values;
  for (const std::uint32_t robot : robots)
  {
    RobotStatus status;
    EXPECT_TRUE(role.Describe(robot, status));
    for (const auto& sensor : status.sensors)
      for (const CCI_Reading& reading : sensor.readings) values.push_back(reading.value);
  }
  return values;
}

TEST_P(Swarms, AreSensedFromThePartAsFromAll)
{
  std::mt19937 random(7);
  const Experiment experiment = Swarm(GetParam(), random);
  const Assignment assignment = MakeAssignment(experiment, kHosts);
  CSwarmanoidSpace space(experiment);
  std::vector<std::unique_ptr<Host>> whole, local;
  std::vector<Surroundings> surroundings;
  for (unsigned h = 0; h < kHosts; ++h)
  {
    whole.push_back(std::make_unique<Host>(experiment, assignment, h));
    local.push_back(std::make_unique<Host>(experiment, assignment, h));
    ASSERT_TRUE(std::isfinite(whole.back()->role.Reach()));
    surroundings.emplace_back(space, assignment.hosts[h].robots, whole.back()->role.Reach());
  }

  std::uniform_real_distribution<double> step(-0.04, 0.04), place(0.3, kSide - 0.3);
  std::uniform_int_distribution<std::uint32_t> some(0, kRobots - 1);
  std::set<std::uint32_t> changed;
  std::vector<std::uint32_t> moved;
  std::size_t sensed = 0, told = 0;
  const std::uint64_t ticks = 60;
  for (std::uint64_t tick = 0; tick < ticks; ++tick)
  {
    space.SetTick(tick);
    SpaceState state;
    state.tick = tick;
    space.WritePoses(state.poses);
    for (const std::uint32_t slot : changed) state.attributes.Add(slot, space.Attributes()[slot]);
    state.moved = moved;
    changed.clear();
    moved.clear();
    // Another process has replaced the host: it knows the whole state of the tick before.
    if (tick == 30) local[1] = Successor(experiment, assignment, 1, *whole[1]);
    for (unsigned h = 0; h < kHosts; ++h)
    {
      const LocalState& part = surroundings[h].Part(state);
      told += part.entities.size();
      whole[h]->space.Apply(state);
      local[h]->space.Apply(part, local[h]->near);
      const ControlCommands& expected = whole[h]->role.Tick({});
      const ControlCommands& commands = local[h]->role.Tick({});
      ASSERT_EQ(commands.values, expected.values);
      ASSERT_EQ(commands.attributes.slots, expected.attributes.slots);
      ASSERT_EQ(commands.attributes.values, expected.attributes.values);
      const std::vector<double> readings = ReadingsOf(whole[h]->role, assignment.hosts[h].robots);
      for (const std::uint32_t robot : assignment.hosts[h].robots)
        ASSERT_EQ(ReadingsOf(local[h]->role, {robot}), ReadingsOf(whole[h]->role, {robot}))
            << "robot " << robot << " of host " << h << " at tick " << tick;
      sensed += readings.size();
    }
    for (const auto& host : whole)
    {
      const AttributeChanges& commanded = host->role.Commands().attributes;
      space.SetAttributes(commanded);
      changed.insert(commanded.slots.begin(), commanded.slots.end());
    }
    for (std::uint32_t entity = 0; entity < kRobots; ++entity)
    {
      if (entity % 4 == tick / 8 % 4) continue;  // it rests
      Pose pose = space.GetPose(entity);
      pose.position.x() += (entity % 7 == 0 ? 3 : 1) * step(random);
      pose.position.y() += step(random);
      space.SetPose(entity, pose);
    }
    if (tick % 16 == 5)
    {
      moved = {some(random)};
      space.SetPose(moved[0], {{place(random), place(random), 0}, Pose().orientation});
    }
    if (tick % 8 == 3)
    {
      const std::uint32_t entity = some(random);
      space.SetAttribute(space.PresenceSlot(entity), space.IsPresent(entity) ? 0 : 1);
      changed.insert(space.PresenceSlot(entity));
    }
  }
  EXPECT_GT(sensed, 100U);
  EXPECT_LT(told, ticks * kHosts * kRobots * 8 / 10) << "most are told of most";
}

INSTANTIATE_TEST_SUITE_P(
    , Swarms,
    testing::Values(Sensor{"footbot_proximity", "generic_footbot_proximity"}, Sensor{"proximity", "generic_proximity"},
                    Sensor{"range_and_bearing", "generic_range_and_bearing"},
                    Sensor{"footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera"},
                    Sensor{"footbot_perspective_camera", "generic_footbot_perspective_camera"},
                    Sensor{"pie_camera", "generic_pie_camera"}, Sensor{"contact", "generic_contact"},
                    Sensor{"footbot_distance_scanner", "generic_footbot_distance_scanner"},
                    Sensor{"positioning", "generic_positioning"}),
    [](const auto& of) { return of.param.type; });

// These sensors need every entity.
TEST(Reach, OfLightAndSoundIsWithoutEnd)
{
  std::mt19937 random(7);
  for (const Sensor& sensor : {Sensor{"footbot_light", "generic_footbot_light"}, Sensor{"radio", "generic_radio"},
                               Sensor{"microphone", "generic_microphone"}})
  {
    const Experiment experiment = Swarm(sensor, random);
    const Assignment assignment = MakeAssignment(experiment, kHosts);
    const Host host(experiment, assignment, 0);
    EXPECT_TRUE(std::isinf(host.role.Reach())) << sensor.type;
  }
}

}  // namespace
}  // namespace swarmanoid
