// Commands that act a tick after the control step that made them (framework.ahead).
#include <gmock/gmock.h>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/space/attributes.h"
#include "controller_host/controller_host.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

// Its wheels are as fast as the number of its step, in mm/s; its LEDs are lit by the second one, and dark in the third.
// It fails in the fourth.
class Counter : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    if (++steps_ == 4 && GetRobot()->GetId() == "a") throw std::runtime_error("no way");
    GetRobot()->Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(steps_ * 1e-3, steps_ * 1e-3);
    GetRobot()->Actuator<CCI_LedRingActuator>("led_ring").SetAllColours(steps_ == 2 ? 0xff0000 : 0);
  }
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override { state << steps_; }
  void LoadState(std::istream& state) override { state >> steps_; }

private:
  int steps_ = 0;
};

REGISTER_CONTROLLER(Counter, "late_commands_test")

Experiment TwoCounters(std::uint32_t ahead)
{
  RegisterBuiltinDevices();
  Experiment experiment = test::RobotsOf("late_commands_test", {"a", "b"}, {"generic_wheels", "generic_led_ring"});
  experiment.ahead = ahead;
  experiment.controllers[0].on_failure = OnFailure::kStopRobot;
  return experiment;
}

class Hosted
{
public:
  explicit Hosted(std::uint32_t ahead) : experiment_(TwoCounters(ahead)) {}

  const ControlCommands& Tick(std::uint64_t tick)
  {
    space.SetTick(tick);
    const ControlCommands& commands = host.Tick({});
    Act(commands);
    return commands;
  }
  // Changes the space as the server does behind the tick.
  void Act(const ControlCommands& commands) { space.SetAttributes(commands.attributes); }

private:
  const Experiment experiment_;
  const Assignment assignment_ = MakeAssignment(experiment_, 1);

public:
  CSwarmanoidSpace space{experiment_};
  ControllerHost host{space, assignment_, 0};
};

TEST(LateCommands, AreThoseThatWouldHaveActedATickBefore)
{
  Hosted now(0), late(1);
  EXPECT_EQ(now.host.Due(), nullptr);
  ControlCommands before = now.host.Commands();
  EXPECT_THAT(before.values, ElementsAre(0, 0, 0, 0));
  bool has_lit = false, has_failed = false;
  for (std::uint64_t tick = 0; tick < 8; ++tick)
  {
    late.space.SetTick(tick);
    const ControlCommands* due = late.host.Due();
    ASSERT_NE(due, nullptr);
    EXPECT_EQ(due->tick, tick);
    EXPECT_EQ(due->values, before.values) << tick;
    EXPECT_EQ(due->attributes.slots, before.attributes.slots) << tick;
    EXPECT_EQ(due->attributes.values, before.attributes.values) << tick;
    EXPECT_EQ(due->faults, before.faults) << tick;
    EXPECT_EQ(&late.host.Tick({}), due);
    EXPECT_EQ(due->values, before.values) << "the step of the tick changed them";
    late.Act(*due);
    has_lit |= !due->attributes.slots.empty();
    has_failed |= !due->faults.robots.empty();
    before = now.Tick(tick);
  }
  EXPECT_TRUE(has_lit && has_failed);
}

TEST(LateCommands, AreSaved)
{
  // The checkpoints are after the step that lights the LEDs and after the step that fails.
  for (const std::uint64_t ticks : {2U, 4U})
  {
    Hosted whole(1), restored(1);
    for (std::uint64_t tick = 0; tick < ticks; ++tick) whole.Tick(tick);
    ByteWriter saved;
    whole.host.SaveState(saved);
    ByteReader read(saved.Bytes());
    restored.space.SetTick(ticks);
    restored.host.LoadState(read);
    EXPECT_TRUE(read.AtEnd());
    for (std::uint64_t tick = ticks; tick < ticks + 3; ++tick)
    {
      const ControlCommands& expected = whole.Tick(tick);
      const ControlCommands& found = restored.Tick(tick);
      EXPECT_EQ(found.values, expected.values) << tick;
      EXPECT_EQ(found.attributes.slots, expected.attributes.slots) << tick;
      EXPECT_EQ(found.attributes.values, expected.attributes.values) << tick;
      EXPECT_EQ(found.faults, expected.faults) << tick;
      if (tick > ticks) continue;
      EXPECT_EQ(found.attributes.slots.empty() && found.faults.robots.empty(), false);
    }
  }
}

}  // namespace
}  // namespace swarmanoid
