// The limits of users' code go to the processes of a cluster by the environment.
#include "common/limits/limits.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "common/activity/activity.h"
#include "common/limits/step_timeout.h"
#include "tests/eventually.h"

namespace swarmanoid
{
namespace
{

struct LimitsByTheEnvironment : testing::Test
{
  ~LimitsByTheEnvironment() override
  {
    for (const auto& [name, value] : EnvironmentOf({1, 1})) unsetenv(name.c_str());
  }

  static Limits Passed(const Limits& limits)
  {
    for (const auto& [name, value] : EnvironmentOf(limits)) setenv(name.c_str(), value.c_str(), 1);
    return LimitsOfEnvironment();
  }
};

TEST_F(LimitsByTheEnvironment, ComeAsTheyWere)
{
  const Limits limits = Passed({(std::uint64_t{1} << 40U) + 1, 0.1});
  EXPECT_EQ(limits.memory_bytes, (std::uint64_t{1} << 40U) + 1);
  EXPECT_EQ(limits.step_s, 0.1);
}

TEST_F(LimitsByTheEnvironment, AreNoneWithoutAText)
{
  EXPECT_TRUE(EnvironmentOf({}).empty());
  const Limits limits = LimitsOfEnvironment();
  EXPECT_EQ(limits.memory_bytes, 0U);
  EXPECT_EQ(limits.step_s, 0);
}

TEST_F(LimitsByTheEnvironment, AreNoneByATextThatIsNoNumber)
{
  for (const auto& [name, value] : EnvironmentOf({1, 1}))
    for (const char* text : {"", "12 GiB", "much", "-1x"})
    {
      setenv(name.c_str(), text, 1);
      const Limits limits = LimitsOfEnvironment();
      EXPECT_EQ(limits.memory_bytes, 0U) << name << "=" << text;
      EXPECT_EQ(limits.step_s, 0) << name << "=" << text;
    }
}

constexpr Actor kSlow{Actor::kRobot, 3, "fb_3", "driver"};

// Runs one step of a robot for a while under a limit.
void StepFor(std::chrono::milliseconds time, StepTimeout::Settings settings,
             ActivityStep step = ActivityStep::kControlStep)
{
  const StepTimeout watch(std::move(settings));
  const Activity activity(kSlow, step, 7);
  std::this_thread::sleep_for(time);
}

TEST(StepTimeoutDeathTest, AStepThatDoesNotReturnEndsTheProcess)
{
  using namespace std::chrono_literals;
  const auto ends_with_4 = testing::ExitedWithCode(4);
  EXPECT_EXIT(StepFor(test::kGenerous, {.limit = 50ms, .stalled = {}}), ends_with_4,
              "robot 'fb_3', controller 'driver': ControlStep at tick 7 did not return within 0.05 s "
              ".--step-timeout.");
  EXPECT_EXIT(
      StepFor(test::kGenerous, {.limit = 50ms, .stalled = {}, .cause = "timeout", .of = ActivityStep::kControlStep}),
      ends_with_4, "within 0.05 s .timeout.");
}

TEST(StepTimeout, OtherStepsAndStepsWithoutALimitTakeAsLongAsTheyWant)
{
  using namespace std::chrono_literals;
  StepFor(100ms, {});
  StepFor(100ms, {.limit = 20ms, .stalled = {}}, ActivityStep::kFinish);
  StepFor(100ms, {.limit = 20ms, .stalled = {}, .of = ActivityStep::kInit});
  const StepTimeout watch({.limit = 20ms, .stalled = {}});
  std::this_thread::sleep_for(100ms);  // no code of a plug-in runs
}

}  // namespace
}  // namespace swarmanoid
