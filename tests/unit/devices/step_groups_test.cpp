// Controllers of a group make their control steps by one call of the host, each with the clock and the random numbers
// of its own step.
#include <gmock/gmock.h>

#include "common/control_interface/ci_step_group.h"
#include "controller_host/controller_host.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

// A group notes the robots of each call, and draws a random number for each.
struct Calls : CCI_StepGroup
{
  void ControlSteps(std::span<CCI_Controller* const> controllers) override
  {
    std::string& robots = calls.emplace_back();
    for (const CCI_Controller* controller : controllers)
    {
      CCI_Robot& robot = *controller->GetRobot();
      robots += robot.GetId() + "@" + std::to_string(robot.GetTick()) + " ";
      numbers.push_back(robot.GetRandom().Uniform());
    }
    if (fails) throw std::runtime_error("no way");
  }

  std::vector<std::string> calls;
  std::vector<double> numbers;
  bool fails = false;
};
Calls* group = nullptr;

class Grouped : public CCI_Controller, public CCI_InStepGroup
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    CCI_Controller* const self = this;
    group->ControlSteps(std::span(&self, 1));
  }
  CCI_StepGroup& StepGroup() override { return *group; }
};
REGISTER_CONTROLLER(Grouped, "step_groups_test")

struct Scene
{
  explicit Scene(Calls& calls, OnFailure on_failure = OnFailure::kAbort)
  {
    group = &calls;
    experiment.arena_size = {10, 10, 2};
    test::AddController(experiment, "step_groups_test", "c");
    experiment.controllers.back().on_failure = on_failure;
    for (const char* id : {"a", "b", "d"})
    {
      EntityConfiguration robot = test::Entity(EntityKind::kFootbot, id);
      robot.controller = "c";
      robot.waits = std::string(id) == "d";
      test::Add(experiment, robot);
    }
  }
  std::string ErrorOfTicks(std::uint64_t ticks)
  {
    const Assignment assignment = MakeAssignment(experiment, 1);
    CSwarmanoidSpace space(experiment);
    ControllerHost host(space, assignment, 0);
    return test::MessageOf<ActivityError>(
        [&]
        {
          for (std::uint64_t tick = 0; tick < ticks; ++tick)
          {
            space.SetTick(tick);
            host.Tick({});
          }
        });
  }

  Experiment experiment;
};

TEST(StepGroups, GetTheirRobotsInTheArenaByOneCallATick)
{
  Calls calls;
  EXPECT_EQ(Scene(calls).ErrorOfTicks(2), "");
  EXPECT_THAT(calls.calls, testing::ElementsAre("a@0 b@0 ", "a@1 b@1 "));
}

TEST(StepGroups, HaveTheRandomNumbersOfStepsAlone)
{
  Calls together, alone;
  EXPECT_EQ(Scene(together).ErrorOfTicks(3), "");
  EXPECT_EQ(Scene(alone, OnFailure::kStopRobot).ErrorOfTicks(3), "");
  EXPECT_THAT(alone.calls, testing::ElementsAre("a@0 ", "b@0 ", "a@1 ", "b@1 ", "a@2 ", "b@2 "));
  EXPECT_EQ(together.numbers, alone.numbers);
}

TEST(StepGroups, AFailureNamesTheFirstRobotAndTheTick)
{
  Calls calls;
  calls.fails = true;
  EXPECT_EQ(Scene(calls).ErrorOfTicks(1), "robot 'a', controller 'c': ControlStep at tick 0 failed: no way");
}

}  // namespace
}  // namespace swarmanoid
