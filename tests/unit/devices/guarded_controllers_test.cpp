// Controllers with on_failure or a time budget: the reaction of their host to a failure, at once, when the tick is
// repeated, and after its state was saved.
#include <gmock/gmock.h>

#include <ctime>
#include <functional>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/space/attributes.h"
#include "controller_host/controller_host.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Gt;
using testing::HasSubstr;

// Drives with its LEDs on, counts its steps, and then calls the function of the test.
class Guarded : public CCI_Controller
{
public:
  static inline std::function<void(const std::string& id, std::uint64_t tick, int steps)> step;
  static inline std::function<void()> init;
  static inline std::function<void()> destroy;
  static inline double speed = 0.1;  // m/s

  int Init(const TConfigurationTree) override
  {
    if (init) init();
    return RETURN_OK;
  }
  void ControlStep() override
  {
    GetRobot()->Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(speed, 2 * speed);
    GetRobot()->Actuator<CCI_LedRingActuator>("led_ring").SetAllColours(0xff0000);
    ++steps_;
    if (step) step(GetRobot()->GetId(), GetRobot()->GetTick(), steps_);
  }
  void Destroy() override
  {
    if (destroy) destroy();
  }
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override { state << steps_; }
  void LoadState(std::istream& state) override { state >> steps_; }
  std::string StatusText() const override { return std::to_string(steps_); }

private:
  int steps_ = 0;
};

REGISTER_CONTROLLER(Guarded, "guarded_controllers_test")

void Spin(double ms)
{
  const std::clock_t end = std::clock() + static_cast<std::clock_t>(ms * CLOCKS_PER_SEC / 1000);
  while (std::clock() < end) continue;
}

Experiment TwoRobots(OnFailure on_failure, double time_budget_ms)
{
  RegisterBuiltinDevices();
  Experiment experiment =
      test::RobotsOf("guarded_controllers_test", {"a", "b"}, {"generic_wheels", "generic_led_ring"});
  experiment.canonical_period = 10;
  experiment.controllers[0].on_failure = on_failure;
  experiment.controllers[0].time_budget_ms = time_budget_ms;
  return experiment;
}

// A host and the space that it sees, with what it set.
class Hosted
{
public:
  explicit Hosted(OnFailure on_failure, double time_budget_ms = 0)
      : experiment_(TwoRobots(on_failure, time_budget_ms)), assignment_(MakeAssignment(experiment_, 1))
  {
  }
  const ControlCommands& Tick(std::uint64_t tick)
  {
    space.SetTick(tick);
    const ControlCommands& commands = host.Tick({});
    for (std::size_t k = 0; k < commands.attributes.slots.size(); ++k)
      space.SetAttribute(commands.attributes.slots[k], commands.attributes.values[k]);
    return commands;
  }
  std::vector<double> Leds(std::size_t robot) const
  {
    std::vector<double> leds;
    for (int k = 0; k < FindAttribute(EntityKind::kFootbot, "led")->count; ++k)
      leds.push_back(space.Attributes()[space.GetEntity(robot).SlotOf("led", k)]);
    return leds;
  }
  RobotStatus Status(std::uint32_t robot) const
  {
    RobotStatus status;
    EXPECT_TRUE(host.Describe(robot, status));
    return status;
  }

private:
  const Experiment experiment_;
  const Assignment assignment_;

public:
  CSwarmanoidSpace space{experiment_};
  ControllerHost host{space, assignment_, 0};
};

class GuardedControllers : public testing::Test
{
protected:
  ~GuardedControllers() override { Guarded::step = nullptr, Guarded::init = nullptr, Guarded::destroy = nullptr; }

  // The controller of `a` throws in the ticks of the list.
  static void ThrowAt(std::vector<std::uint64_t> ticks)
  {
    Guarded::step = [ticks = std::move(ticks)](const std::string& id, std::uint64_t tick, int)
    {
      if (id == "a" && std::find(ticks.begin(), ticks.end(), tick) != ticks.end()) throw std::runtime_error("no way");
    };
  }
};

TEST_F(GuardedControllers, WhatThrowsEndsTheRunUnlessTheFileSaysOtherwise)
{
  ThrowAt({2});
  Hosted run(OnFailure::kAbort, 1000);
  run.Tick(0);
  run.Tick(1);
  EXPECT_EQ(test::MessageOf<ActivityError>([&] { run.Tick(2); }),
            "robot 'a', controller 'c': ControlStep at tick 2 failed: no way");
}

TEST_F(GuardedControllers, OneThatIsStoppedCommandsNothingAndIsDark)
{
  ThrowAt({2});
  int destroyed = 0;
  Guarded::destroy = [&] { ++destroyed; };
  Hosted run(OnFailure::kStopRobot);
  for (std::uint64_t tick = 0; tick < 2; ++tick)
  {
    const ControlCommands& commands = run.Tick(tick);
    EXPECT_TRUE(commands.faults.robots.empty());
    EXPECT_THAT(commands.values, ElementsAre(Gt(0), Gt(0), Gt(0), Gt(0)));
    EXPECT_THAT(run.Leds(0), Each(0xff0000));
  }
  const ControlCommands& commands = run.Tick(2);
  EXPECT_EQ(commands.faults, (ControllerFaults{{0}, {FaultKind::kThrew}}));
  for (std::uint64_t tick = 3; tick < 6; ++tick)
  {
    EXPECT_THAT(commands.values, ElementsAre(0, 0, Gt(0), Gt(0))) << tick;
    EXPECT_THAT(run.Leds(0), Each(0));
    EXPECT_THAT(run.Leds(1), Each(0xff0000));
    // The test switches an LED on from outside.
    if (tick == 4) run.space.SetAttribute(run.space.GetEntity(0).SlotOf("led", 3), 0xff);
    run.Tick(tick);
    EXPECT_TRUE(commands.faults.robots.empty());
  }
  EXPECT_EQ(run.Status(0).state, "stopped");
  EXPECT_EQ(run.Status(0).text, "its controller threw an exception at tick 2");
  EXPECT_EQ(run.Status(1).text, "6");
  run.host.Destroy();
  EXPECT_EQ(destroyed, 1);
}

TEST_F(GuardedControllers, OneThatIsStartedAgainHasTheStateOfTheLastCanonicalTick)
{
  // After tick 9, and so at tick 10, it had ten steps; in tick 14 it makes its fifteenth.
  ThrowAt({14});
  Hosted run(OnFailure::kRestart);
  for (std::uint64_t tick = 0; tick < 14; ++tick) run.Tick(tick);
  EXPECT_EQ(run.Status(0).text, "14");
  const ControlCommands& commands = run.Tick(14);
  EXPECT_EQ(commands.faults, (ControllerFaults{{0}, {FaultKind::kThrew}}));
  EXPECT_EQ(run.Status(0).text, "10");
  EXPECT_EQ(run.Status(1).text, "15");
  // Until its next step its actuators keep their commands.
  EXPECT_THAT(commands.values, ElementsAre(Gt(0), Gt(0), Gt(0), Gt(0)));
  run.Tick(15);
  EXPECT_EQ(run.Status(0).text, "11");
}

// A process that dies in a step has set no actuators; its replacement does the tick without the step.
TEST_F(GuardedControllers, AStepThatThrowsAndOneThatCrashesLeaveWhatTheTickBeforeSaid)
{
  const auto commands_of_fault = [](FaultKind kind)
  {
    Guarded::step = [kind](const std::string& id, std::uint64_t tick, int)
    {
      if (id == "a" && tick == 3 && kind == FaultKind::kThrew) throw std::runtime_error("no way");
    };
    Hosted run(OnFailure::kRestart);
    for (std::uint64_t tick = 0; tick < 3; ++tick) run.Tick(tick);
    const std::vector<double> before = run.host.NewestCommands().values;
    Guarded::speed = 0.15;
    if (kind == FaultKind::kDied) run.host.KnowTick(3, {{0}, {kind}});
    const ControlCommands commands = run.Tick(3);
    Guarded::speed = 0.1;
    EXPECT_EQ(commands.faults, (ControllerFaults{{0}, {kind}}));
    EXPECT_EQ(commands.values[0], before[0]) << "what the robot that failed was told in the tick before";
    EXPECT_GT(commands.values[2], before[2]) << "the other robot is told the new speed";
    EXPECT_THAT(run.Leds(0), Each(0xff0000));
    return commands.values;
  };
  EXPECT_EQ(commands_of_fault(FaultKind::kThrew), commands_of_fault(FaultKind::kDied));
}

TEST_F(GuardedControllers, OneThatFailsTooOftenIsStopped)
{
  for (const std::uint64_t apart : {100U, 101U})
  {
    std::vector<std::uint64_t> ticks;
    for (std::uint64_t n = 1; n <= 4; ++n) ticks.push_back(n * apart);
    ThrowAt(ticks);
    Hosted run(OnFailure::kRestart);
    for (std::uint64_t tick = 0; tick <= 4 * apart; ++tick) run.Tick(tick);
    EXPECT_EQ(run.Status(0).state == "stopped", apart == 100) << apart;
  }
}

TEST_F(GuardedControllers, OneThatCannotBeginAgainIsStopped)
{
  ThrowAt({2});
  Hosted run(OnFailure::kRestart);
  Guarded::init = [] { throw std::runtime_error("not twice"); };
  for (std::uint64_t tick = 0; tick < 5; ++tick) run.Tick(tick);
  EXPECT_EQ(run.Status(0).state, "stopped");
  EXPECT_EQ(run.Status(1).text, "5");
}

TEST_F(GuardedControllers, TimeOfTheProcessorIsWhatABudgetLimits)
{
  Guarded::step = [](const std::string& id, std::uint64_t tick, int)
  {
    if (id == "b" && tick == 2) Spin(60);
  };
  Hosted run(OnFailure::kStopRobot, 30);
  for (std::uint64_t tick = 0; tick < 2; ++tick) EXPECT_TRUE(run.Tick(tick).faults.robots.empty());
  EXPECT_EQ(run.Tick(2).faults, (ControllerFaults{{1}, {FaultKind::kTooSlow}}));
  EXPECT_EQ(run.Status(1).state, "stopped");

  Hosted ended(OnFailure::kAbort, 30);
  ended.Tick(0);
  EXPECT_THAT([&] { ended.Tick(2); },
              testing::ThrowsMessage<ActivityError>(AllOf(HasSubstr(
                  "robot 'b', controller 'c': ControlStep at tick 2 took more processor time than its 30 ms"))));
}

TEST_F(GuardedControllers, WhatIsKnownOfATickIsNotMeasured)
{
  Guarded::step = [](const std::string&, std::uint64_t tick, int)
  {
    if (tick < 3) Spin(60);
  };
  // The faults of that tick are known.
  Hosted run(OnFailure::kStopRobot, 30);
  run.host.KnowTick(0, {});
  EXPECT_TRUE(run.Tick(0).faults.robots.empty());
  run.host.KnowTick(1, {{1}, {FaultKind::kTooSlow}});
  EXPECT_EQ(run.Tick(1).faults, (ControllerFaults{{1}, {FaultKind::kTooSlow}}));
  EXPECT_EQ(run.Tick(2).faults, (ControllerFaults{{0}, {FaultKind::kTooSlow}}));  // measured
  // The faults of all ticks until then are known.
  Hosted other(OnFailure::kStopRobot, 30);
  other.host.Know({2, {{1, 1, FaultKind::kTooSlow}}});
  EXPECT_TRUE(other.Tick(0).faults.robots.empty());
  EXPECT_EQ(other.Tick(1).faults, (ControllerFaults{{1}, {FaultKind::kTooSlow}}));
  EXPECT_EQ(other.Tick(2).faults, (ControllerFaults{{0}, {FaultKind::kTooSlow}}));
}

TEST_F(GuardedControllers, OneThatDiedIsNotCalledWhereItDid)
{
  std::vector<std::uint64_t> called;
  Guarded::step = [&](const std::string& id, std::uint64_t tick, int)
  {
    if (id == "a") called.push_back(tick);
  };
  Hosted run(OnFailure::kRestart);
  // In any order: from the command line and from the server.
  run.host.Know({0, {{3, 0, FaultKind::kDied}, {1, 0, FaultKind::kDied}}});
  for (std::uint64_t tick = 0; tick < 5; ++tick) run.Tick(tick);
  EXPECT_THAT(called, ElementsAre(0, 2, 4));
}

TEST_F(GuardedControllers, WhoeverIsRestoredGoesOnAlike)
{
  // `a` is stopped at 24, after its fourth failure.
  const std::vector<std::uint64_t> fails{12, 15, 17, 24};
  ThrowAt(fails);
  Hosted whole(OnFailure::kRestart);
  std::vector<std::vector<char>> saved(61);
  const auto state_of = [](const Hosted& run)
  {
    ByteWriter state;
    run.host.SaveState(state);
    return state.Bytes();
  };
  for (std::uint64_t tick = 0; tick < 60; ++tick)
  {
    whole.Tick(tick);
    saved[tick + 1] = state_of(whole);
  }
  for (const std::uint64_t from : {10U, 20U, 30U})
  {
    Hosted restored(OnFailure::kRestart);
    restored.space.SetTick(from);
    ByteReader state(saved[from]);
    restored.host.LoadState(state);
    EXPECT_TRUE(state.AtEnd());
    EXPECT_EQ(state_of(restored), saved[from]);
    for (std::uint64_t tick = from; tick < 60; ++tick)
    {
      const ControlCommands& commands = restored.Tick(tick);
      EXPECT_EQ(state_of(restored), saved[tick + 1]) << from << " " << tick;
      EXPECT_EQ(commands.faults.robots.size(), static_cast<std::size_t>(std::count(fails.begin(), fails.end(), tick)));
      if (tick < 24) continue;
      EXPECT_THAT(commands.values, ElementsAre(0, 0, Gt(0), Gt(0)));
    }
    EXPECT_THAT(restored.Leds(0), Each(0));
  }
  // A host whose robot was stopped begins again before that.
  whole.space.SetTick(20);
  ByteReader state(saved[20]);
  whole.host.LoadState(state);
  EXPECT_THAT(whole.Tick(20).values, ElementsAre(Gt(0), Gt(0), Gt(0), Gt(0)));
  EXPECT_THAT(whole.Leds(0), Each(0xff0000));
}

}  // namespace
}  // namespace swarmanoid
