// The silence of others counts only while this process could hear them.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "common/bus/delayed_calls.h"
#include "common/bus/guarded.h"
#include "common/bus/listening_clock.h"
#include "tests/eventually.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Time = ListeningClock::Clock::time_point;

TEST(ListeningClock, CountsAllTimeOfAProcessThatRuns)
{
  ListeningClock clock;
  const auto start = clock.At(Time{});
  for (int k = 1; k <= 100; ++k)
    EXPECT_EQ(clock.At(Time{} + k * ListeningClock::kPeriod) - start, k * ListeningClock::kPeriod);
}

// At a load of 60 on two cores, the thread runs once in a while, for a moment.
TEST(ListeningClock, CountsNoTimeInWhichTheProcessDidNotRun)
{
  ListeningClock clock;
  const auto start = clock.At(Time{});
  for (int k = 1; k <= 10; ++k) EXPECT_EQ(clock.At(Time{} + k * 3s) - start, k * ListeningClock::kMostBetween);
}

// A silence of 2 s has room for four announcements of half a second, also if each of its looks comes 30 periods late.
TEST(ListeningClock, ASilenceLastsAsManyLooksHoweverLateTheyAre)
{
  for (const auto late : {0ms, 100ms, 1500ms})
  {
    ListeningClock clock;
    const auto start = clock.At(Time{});
    int looks = 0;
    for (Time now{}; clock.At(now) - start < 2s; ++looks) now += ListeningClock::kPeriod + late;
    EXPECT_GE(looks, 20) << late.count();
  }
}

TEST(ListeningClock, NeverGoesBack)
{
  ListeningClock clock;
  const auto before = clock.At(Time{} + 10s);
  EXPECT_EQ(clock.At(Time{} + 9s), before);
  EXPECT_EQ(clock.At(Time{} + 10s), before);
  EXPECT_EQ(clock.At(Time{} + 10s + 20ms), before + 20ms);
}

// The names of the calls that were made, in their order.
struct MadeCalls
{
  Guarded<std::vector<std::string>> names;

  std::function<void()> Note(const std::string& name)
  {
    return [this, name] { names.Lock()->push_back(name); };
  }
  bool Eventually(const std::vector<std::string>& wanted)
  {
    return test::Eventually([&] { return *names.Lock() == wanted; });
  }
};

TEST(DelayedCalls, AreMadeInTheOrderOfTheirDelays)
{
  MadeCalls made;
  std::atomic<bool> goes_on = false;
  DelayedCalls calls;
  calls.Schedule("first", 0s,
                 [&]
                 {
                   while (!goes_on) std::this_thread::sleep_for(1ms);
                   made.Note("first")();
                 });
  calls.Schedule("never", 1h, made.Note("never"));
  calls.Schedule("third", 200ms, made.Note("third"));
  calls.Schedule("second", 100ms, made.Note("second"));
  goes_on = true;
  EXPECT_TRUE(made.Eventually({"first", "second", "third"}));
}

TEST(DelayedCalls, OfOneNameAreMadeOnceUntilTheyAreForgotten)
{
  MadeCalls made;
  DelayedCalls calls;
  calls.Schedule("a", 1h, made.Note("late"));
  calls.Schedule("a", 0s, made.Note("second"));
  calls.Schedule("b", 0s, made.Note("other"));
  EXPECT_TRUE(made.Eventually({"other"}));
  calls.Forget("a");
  calls.Schedule("a", 0s, made.Note("third"));
  EXPECT_TRUE(made.Eventually({"other", "third"}));
  calls.Schedule("a", 1h, made.Note("late"));
  calls.Cancel("a");
  calls.Schedule("a", 0s, made.Note("fourth"));
  EXPECT_TRUE(made.Eventually({"other", "third", "fourth"}));
}

TEST(DelayedCalls, AreWaitedForByCancelAndByTheEnd)
{
  for (const bool at_end : {false, true})
  {
    std::atomic<bool> begun = false, goes_on = false, ended = false;
    {
      DelayedCalls calls;
      calls.Schedule("a", 0s,
                     [&]
                     {
                       begun = true;
                       while (!goes_on) std::this_thread::sleep_for(1ms);
                       std::this_thread::sleep_for(20ms);
                       ended = true;
                     });
      ASSERT_TRUE(test::Eventually([&] { return begun.load(); }));
      goes_on = true;
      if (!at_end) calls.Cancel("a");
      EXPECT_TRUE(at_end || ended);
    }
    EXPECT_TRUE(ended);
  }
}

TEST(DelayedCalls, AreNotMadeAfterTheEnd)
{
  MadeCalls made;
  DelayedCalls calls;
  calls.Schedule("late", 1h, made.Note("late"));
  calls.Stop();
  calls.Schedule("a", 0s, made.Note("a"));
  std::this_thread::sleep_for(20ms);
  EXPECT_TRUE(made.names.Lock()->empty());
}

}  // namespace
}  // namespace swarmanoid
