// Controllers that allow it step in several threads of their host, and all others one after the other. Failures are the
// same for any number of threads.
#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "common/activity/current_activity.h"
#include "common/control_interface/ci_controller.h"
#include "controller_host/controller_host.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::uint64_t kShared = 5;  // a tick that several threads share, if there are several

// The observations of the controllers of a test.
struct Seen
{
  std::mutex mutex;
  std::set<std::thread::id> threads;
  std::vector<std::string> order;  // the robots that step in turn
  std::vector<std::string> wrong;  // robots whose running code the process could not name
  std::atomic<int> within = 0;
  std::atomic<int> most_within = 0;
  bool meet = false;  // controllers that may step at the same time wait for each other
  std::set<std::string> fails;
};
Seen* seen = nullptr;

class Stepper : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    const int within = ++seen->within;
    for (int most = seen->most_within; most < within && !seen->most_within.compare_exchange_weak(most, within);)
    {
    }
    std::this_thread::sleep_for(100us);
    // The threads meet there, whatever else the machine does. Only threads that never meet reach the limit.
    const auto limit = std::chrono::steady_clock::now() + 10s;
    while (seen->meet && StepsInParallel() && GetRobot()->GetTick() == kShared && seen->most_within < 2 &&
           std::chrono::steady_clock::now() < limit)
      std::this_thread::yield();
    std::string from_outside;
    std::thread([&] { from_outside = CurrentActivity(); }).join();
    const std::string& id = GetRobot()->GetId();
    {
      const std::lock_guard lock(seen->mutex);
      seen->threads.insert(std::this_thread::get_id());
      if (!StepsInParallel()) seen->order.push_back(id);
      const activity::Current now = activity::Now();
      if (now.actor == nullptr || now.actor->id != id || !activity::IsMine() || !from_outside.starts_with("robot '"))
        seen->wrong.push_back(id);
    }
    --seen->within;
    if (seen->fails.contains(id) && GetRobot()->GetTick() == kShared) throw std::runtime_error("no way");
  }
};

class ParallelStepper : public Stepper
{
public:
  bool StepsInParallel() const override { return true; }
};

REGISTER_CONTROLLER(Stepper, "parallel_controllers_test_in_turn")
REGISTER_CONTROLLER(ParallelStepper, "parallel_controllers_test_parallel")

// Robots a0, a1 … of the first controller and b0, b1 … of the second, in turn, for the ticks in which both ways are
// tried.
std::string ErrorOf(Seen& into, unsigned threads, int in_turn, int parallel)
{
  seen = &into;
  Experiment experiment;
  experiment.arena_size = {10, 10, 2};
  test::AddController(experiment, "parallel_controllers_test_in_turn", "a");
  test::AddController(experiment, "parallel_controllers_test_parallel", "b");
  const auto add = [&](const std::string& controller, int number)
  {
    EntityConfiguration robot = test::Entity(EntityKind::kFootbot, controller + std::to_string(number));
    robot.controller = controller;
    test::Add(experiment, robot);
  };
  for (int k = 0; k < std::max(in_turn, parallel); ++k)
  {
    if (k < in_turn) add("a", k);
    if (k < parallel) add("b", k);
  }
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  WorkerPool pool(threads);
  ControllerHost host(space, assignment, 0, &pool);
  return test::MessageOf<ActivityError>(
      [&]
      {
        for (std::uint64_t tick = 0; tick < 2 * 4; ++tick)
        {
          space.SetTick(tick);
          host.Tick({});
        }
      });
}

TEST(ParallelControllers, StepAtTheSameTime)
{
  Seen into;
  into.meet = true;
  EXPECT_EQ(ErrorOf(into, 3, 0, 9), "");
  EXPECT_GT(into.most_within, 1);
  EXPECT_EQ(into.threads.size(), 3U);
  EXPECT_THAT(into.wrong, testing::IsEmpty());
}

TEST(ParallelControllers, OthersStepInTheOrderOfTheFileInOneThread)
{
  Seen into;
  EXPECT_EQ(ErrorOf(into, 3, 4, 0), "");
  EXPECT_EQ(into.most_within, 1);
  EXPECT_THAT(into.threads, testing::ElementsAre(std::this_thread::get_id()));
  ASSERT_EQ(into.order.size(), 32U);
  for (std::size_t k = 0; k < into.order.size(); ++k) EXPECT_EQ(into.order[k], "a" + std::to_string(k % 4));
}

TEST(ParallelControllers, OfAMixedSwarmOnlyThoseStepAtTheSameTimeThatMay)
{
  Seen into;
  into.meet = true;
  EXPECT_EQ(ErrorOf(into, 2, 3, 8), "");
  EXPECT_GT(into.most_within, 1);
  ASSERT_EQ(into.order.size(), 24U);
  for (std::size_t k = 0; k < into.order.size(); ++k) EXPECT_EQ(into.order[k], "a" + std::to_string(k % 3));
  EXPECT_THAT(into.wrong, testing::IsEmpty());
}

TEST(ParallelControllers, TheFirstOfThoseThatFailIsNamedHoweverManyThreadsThereAre)
{
  for (const unsigned threads : {1U, 2U, 3U, 8U})
  {
    Seen into;
    into.fails = {"b3", "b5", "b7"};
    EXPECT_EQ(ErrorOf(into, threads, 0, 8), "robot 'b3', controller 'b': ControlStep at tick 5 failed: no way")
        << threads;
  }
}

}  // namespace
}  // namespace swarmanoid
