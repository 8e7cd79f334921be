// A host makes the control steps of batch controllers by one call a tick, each robot with the clock and the random
// numbers of its own step.
#include <gmock/gmock.h>

#include <limits>
#include <mutex>
#include <set>

#include "common/activity/current_activity.h"
#include "common/control_interface/ci_batch_controller.h"
#include "common/space/space.h"
#include "common/threads/worker_pool.h"
#include "controller_host/controller_host.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

// The robots of each call, and a random number of each robot.
struct Calls
{
  std::mutex mutex;
  std::vector<std::string> calls;
  std::vector<double> numbers;
  std::set<std::string> names;  // of the actors that the process named
  std::string fails;            // the robot whose call throws
  std::string wrong;            // the robot that gets a command that is no number
};
Calls* noted = nullptr;

class Noting : public CCI_BatchController
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlSteps(CCI_Batch& robots) override
  {
    std::string text;
    std::vector<double> drawn;
    const CCI_Commands wheels = robots.Commands("wheels");
    for (std::size_t k = 0; k < robots.Size(); ++k)
    {
      CCI_Robot& robot = robots.Robot(k);
      text += robot.GetId() + "@" + std::to_string(robot.GetTick()) + " ";
      drawn.push_back(robot.GetRandom().Uniform());
      std::ranges::fill(wheels[k], robot.GetId() == noted->wrong ? std::numeric_limits<double>::quiet_NaN() : 1.0);
      ++robots.Of<Noting>(k).steps_;
    }
    const std::lock_guard lock(noted->mutex);
    noted->calls.push_back(text);
    noted->numbers.insert(noted->numbers.end(), drawn.begin(), drawn.end());
    noted->names.insert(activity::Now().actor->id);
    if (text.starts_with(noted->fails + "@")) throw std::runtime_error("no way");
  }
  bool HasState() const override { return true; }
  std::string StatusText() const override { return std::to_string(steps_); }

private:
  int steps_ = 0;
};
class ParallelNoting : public Noting
{
public:
  bool StepsInParallel() const override { return true; }
};
REGISTER_CONTROLLER(Noting, "batch_controller_test")
REGISTER_CONTROLLER(ParallelNoting, "batch_controller_test_parallel")

struct Scene
{
  explicit Scene(Calls& calls, const std::vector<std::string>& robots = {"a", "b", "d"},
                 OnFailure on_failure = OnFailure::kAbort, const std::string& tag = "batch_controller_test")
  {
    RegisterBuiltinDevices();
    noted = &calls;
    experiment = test::RobotsOf(tag, robots, {"generic_wheels"});
    experiment.controllers.back().on_failure = on_failure;
  }
  Scene& Waits(const std::string& id)
  {
    for (EntityConfiguration& robot : experiment.entities) robot.waits |= robot.id == id;
    return *this;
  }
  std::string ErrorOfTicks(std::uint64_t ticks, unsigned threads = 1)
  {
    const Assignment assignment = MakeAssignment(experiment, 1);
    CSwarmanoidSpace space(experiment);
    WorkerPool pool(threads);
    ControllerHost host(space, assignment, 0, &pool);
    return test::MessageOf<ActivityError>(
        [&]
        {
          for (std::uint64_t tick = 0; tick < ticks; ++tick)
          {
            space.SetTick(tick);
            host.Tick({});
          }
          for (const std::uint32_t robot : assignment.hosts[0].robots)
          {
            RobotStatus status;
            host.Describe(robot, status);
            steps.push_back(status.text);
          }
        });
  }

  Experiment experiment;
  std::vector<std::string> steps;  // of each robot, as its own controller counts them
};

TEST(BatchControllers, StepTheRobotsInTheArenaByOneCallATick)
{
  Calls calls;
  Scene scene(calls);
  EXPECT_EQ(scene.Waits("b").ErrorOfTicks(2), "");
  EXPECT_THAT(calls.calls, ElementsAre("a@0 d@0 ", "a@1 d@1 "));
  EXPECT_THAT(scene.steps, ElementsAre("2", "0", "2"));
}

TEST(BatchControllers, StepOneRobotAsWell)
{
  Calls calls;
  EXPECT_EQ(Scene(calls, {"a"}).ErrorOfTicks(1), "");
  EXPECT_THAT(calls.calls, ElementsAre("a@0 "));
}

TEST(BatchControllers, AreNotCalledIfNoRobotIsThere)
{
  Calls calls;
  EXPECT_EQ(Scene(calls, {"a"}).Waits("a").ErrorOfTicks(2), "");
  EXPECT_THAT(calls.calls, IsEmpty());
}

TEST(BatchControllers, OfTwoEntriesAreTwoCalls)
{
  Calls calls;
  Scene scene(calls);
  scene.experiment.controllers.push_back(scene.experiment.controllers.front());
  scene.experiment.controllers.back().id = "other";
  scene.experiment.entities[1].controller = "other";
  EXPECT_EQ(scene.ErrorOfTicks(1), "");
  EXPECT_THAT(calls.calls, ElementsAre("a@0 d@0 ", "b@0 "));
}

TEST(BatchControllers, HaveTheRandomNumbersOfStepsAlone)
{
  Calls together, alone;
  EXPECT_EQ(Scene(together).ErrorOfTicks(3), "");
  EXPECT_EQ(Scene(alone, {"a", "b", "d"}, OnFailure::kStopRobot).ErrorOfTicks(3), "");
  EXPECT_EQ(alone.calls.size(), 9U);
  EXPECT_EQ(together.numbers, alone.numbers);
}

TEST(BatchControllers, ThatMayAreDividedAmongThreads)
{
  for (const std::size_t robots : {4U, 20U})
  {
    std::vector<std::string> ids;
    for (std::size_t k = 0; k < robots; ++k) ids.push_back(std::string("r") + static_cast<char>('a' + k));
    Calls whole, divided;
    EXPECT_EQ(Scene(whole, ids).ErrorOfTicks(1, 2), "");
    ASSERT_EQ(whole.calls.size(), 1U);
    EXPECT_EQ(Scene(divided, ids, OnFailure::kAbort, "batch_controller_test_parallel").ErrorOfTicks(1, 2), "");
    // Each part has robots that follow one another, and is called on the controller of the first one.
    EXPECT_EQ(divided.calls.size(), std::min<std::size_t>(robots, WorkerPool(2).Parts()));
    std::ranges::sort(divided.calls);
    std::set<std::string> first;
    std::string all;
    for (const std::string& call : divided.calls)
    {
      first.insert(call.substr(0, call.find('@')));
      all += call;
    }
    EXPECT_EQ(all, whole.calls.front());
    EXPECT_EQ(divided.names, first);
    std::ranges::sort(whole.numbers);
    std::ranges::sort(divided.numbers);
    EXPECT_EQ(whole.numbers, divided.numbers);
  }
}

TEST(BatchControllers, AFailureNamesTheFirstRobotAndTheTick)
{
  Calls calls;
  calls.fails = "a";
  EXPECT_EQ(Scene(calls).ErrorOfTicks(1), "robot 'a', controller 'c': ControlStep at tick 0 failed: no way");
}

TEST(BatchControllers, AFailureInAThreadNamesTheFirstRobotOfThatThread)
{
  Calls calls;
  calls.fails = "d";
  EXPECT_EQ(Scene(calls, {"a", "b", "d", "e"}, OnFailure::kAbort, "batch_controller_test_parallel").ErrorOfTicks(1, 2),
            "robot 'd', controller 'c': ControlStep at tick 0 failed: no way");
}

TEST(BatchControllers, ACommandThatIsNoNumberIsReportedWithItsRobot)
{
  for (const unsigned threads : {1U, 2U})
  {
    Calls calls;
    calls.wrong = "b";
    EXPECT_EQ(
        Scene(calls, {"a", "b", "d"}, OnFailure::kAbort, "batch_controller_test_parallel").ErrorOfTicks(1, threads),
        "robot 'b', controller 'c': ControlStep at tick 0 failed: column 0 ('left [rad/s]') of the actuator 'wheels' "
        "is "
        "not a finite number");
  }
}

TEST(BatchControllers, WithAGuardFailAlone)
{
  Calls calls;
  calls.fails = "b";
  Scene scene(calls, {"a", "b", "d"}, OnFailure::kStopRobot);
  EXPECT_EQ(scene.ErrorOfTicks(2), "");
  EXPECT_THAT(calls.calls, ElementsAre("a@0 ", "b@0 ", "d@0 ", "a@1 ", "d@1 "));
}

}  // namespace
}  // namespace swarmanoid
