// Work is shared where that took less time, and never if it is over in a few microseconds.
#include "common/threads/thread_choice.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

// How many of `pieces` are shared, if a piece takes one thread `alone` and several `shared`.
unsigned Shared(ThreadChoice& choice, unsigned pieces, ThreadChoice::Duration alone, ThreadChoice::Duration shared)
{
  unsigned count = 0;
  for (unsigned k = 0; k < pieces; ++k)
  {
    count += choice.Shares() ? 1 : 0;
    // If the choice says that the time does not matter, any time must do.
    const ThreadChoice::Duration took = choice.Shares() ? shared : alone;
    choice.Took(choice.Measures() ? took : ThreadChoice::Duration(k % 2 == 0 ? 0 : 1'000'000'000));
  }
  return count;
}

// The periods of the start are over; all were worth sharing.
ThreadChoice Settled()
{
  ThreadChoice choice;
  for (unsigned period = ThreadChoice::kFirstPeriod; period < ThreadChoice::kPeriod; period *= 2)
    Shared(choice, period, 100us, 60us);
  return choice;
}

TEST(ThreadChoice, TriesMoreOftenAtTheStart)
{
  ThreadChoice choice;
  for (unsigned period = ThreadChoice::kFirstPeriod; period < ThreadChoice::kPeriod; period *= 2)
    EXPECT_EQ(Shared(choice, period, 100us, 60us), period - ThreadChoice::kTrials) << period;
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 60us), ThreadChoice::kPeriod - ThreadChoice::kTrials);
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 60us), ThreadChoice::kPeriod - ThreadChoice::kTrials);
}

TEST(ThreadChoice, FewMicrosecondsWakeNobody)
{
  ThreadChoice choice = Settled();
  EXPECT_EQ(Shared(choice, 5 * ThreadChoice::kPeriod, 19us, 1us), 0U);
}

// Reading the clock would be a noticeable part of a tick of some microseconds.
TEST(ThreadChoice, MeasuresTrialsAndWhatIsSharedAlone)
{
  ThreadChoice quick = Settled();
  unsigned measured = 0;
  for (unsigned k = 0; k < ThreadChoice::kPeriod; ++k)
  {
    measured += quick.Measures() ? 1 : 0;
    quick.Took(4us);
  }
  EXPECT_EQ(measured, 2 * ThreadChoice::kTrials);
  ThreadChoice slow = Settled();
  Shared(slow, 2 * ThreadChoice::kTrials, 100us, 60us);
  EXPECT_TRUE(slow.Shares());
  EXPECT_TRUE(slow.Measures());
}

TEST(ThreadChoice, SharesWhatIsQuickerSo)
{
  ThreadChoice choice = Settled();
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 60us), ThreadChoice::kPeriod - ThreadChoice::kTrials);
}

// The best of a few pieces is hardly quicker, and the usual one slower.
TEST(ThreadChoice, LittleGainIsNotWorthOtherCores)
{
  ThreadChoice choice = Settled();
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 92us), ThreadChoice::kTrials);
}

TEST(ThreadChoice, TriesWhatIsSlowerAFewTimesAPeriod)
{
  ThreadChoice choice = Settled();
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 160us), ThreadChoice::kTrials);
}

TEST(ThreadChoice, FollowsWhenTheCoresAreTakenAndFreeAgain)
{
  ThreadChoice choice = Settled();
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 60us), ThreadChoice::kPeriod - ThreadChoice::kTrials);
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 4ms), ThreadChoice::kTrials);
  EXPECT_EQ(Shared(choice, ThreadChoice::kPeriod, 100us, 60us), ThreadChoice::kPeriod - ThreadChoice::kTrials);
}

// On a machine that stays busy, trials become rare, and usual again after one that won.
TEST(ThreadChoice, TriesLessOftenWhatWasSlowerAgainAndAgain)
{
  constexpr unsigned kPeriod = ThreadChoice::kPeriod;
  ThreadChoice choice = Settled();
  for (const unsigned periods : {1U, 2U, 4U, 8U, 16U, 16U})
  {
    EXPECT_EQ(Shared(choice, 16, 100us, 4ms), ThreadChoice::kTrials) << periods;
    EXPECT_EQ(Shared(choice, periods * kPeriod - 16, 100us, 4ms), 0U) << periods;
  }
  EXPECT_EQ(Shared(choice, 16 * kPeriod, 100us, 60us), 16 * kPeriod - ThreadChoice::kTrials);
  EXPECT_EQ(Shared(choice, kPeriod, 100us, 4ms), ThreadChoice::kTrials);
}

// Other programs take a core between two trials. Little time is lost until one thread continues.
TEST(ThreadChoice, StopsWhenTheCoresAreTakenBetweenTrials)
{
  ThreadChoice choice = Settled();
  unsigned count = Shared(choice, 100, 100us, 60us);
  EXPECT_EQ(count, 96U);
  count = Shared(choice, ThreadChoice::kPeriod, 100us, 4ms);
  EXPECT_LE(count, 3U);
  EXPECT_GT(Shared(choice, ThreadChoice::kPeriod, 100us, 60us), 500U) << "and tries again";
}

// The work grows. Several threads are still faster than one, though slower than one was at first.
TEST(ThreadChoice, SharesWorkThatGrows)
{
  ThreadChoice choice = Settled();
  unsigned count = Shared(choice, 16, 100us, 60us);
  EXPECT_EQ(count, 12U);
  count = Shared(choice, ThreadChoice::kPeriod, 400us, 240us);
  EXPECT_GE(count, ThreadChoice::kPeriod - 2 * ThreadChoice::kTrials);
}

// Sharing stops if other programs take the cores at the same time.
TEST(ThreadChoice, WorkThatGrowsOnABusyMachineIsNotShared)
{
  ThreadChoice choice = Settled();
  Shared(choice, 16, 100us, 60us);
  EXPECT_LE(Shared(choice, ThreadChoice::kPeriod / 2, 400us, 4ms), 3 + ThreadChoice::kTrials);
}

TEST(ThreadChoice, BearsSomeSlowPiecesAmongManyQuickOnes)
{
  ThreadChoice choice = Settled();
  Shared(choice, 2 * ThreadChoice::kTrials, 100us, 60us);
  for (unsigned k = 2 * ThreadChoice::kTrials; k + 1 < ThreadChoice::kPeriod; ++k)
  {
    ASSERT_TRUE(choice.Shares()) << k;
    choice.Took(k % 20 == 0 ? 4ms : 60us);
  }
}

// The work of another program delays a piece now and then.
TEST(ThreadChoice, OneSlowPieceDoesNotDecide)
{
  ThreadChoice choice = Settled();
  for (unsigned k = 0; k < ThreadChoice::kPeriod; ++k)
  {
    const bool disturbed = k == ThreadChoice::kTrials + 1;
    choice.Took(disturbed ? 10ms : choice.Shares() ? 60us : 100us);
    EXPECT_EQ(choice.Shares(), k + 1 >= ThreadChoice::kTrials && k + 1 < ThreadChoice::kPeriod) << k;
  }
}

// A tick is shared as a whole or not at all. One thread never shares.
TEST(ThreadedTicks, ThePoolKnowsWhetherATickIsShared)
{
  WorkerPool pool(2);
  ThreadedTicks ticks;
  std::set<bool> shared;
  for (unsigned k = 0; k < 2 * ThreadChoice::kTrials; ++k)
    ticks.Do(&pool,
             [&]
             {
               shared.insert(pool.Shares());
               std::this_thread::sleep_for(2 * ThreadChoice::kWorthWaking);
             });
  EXPECT_EQ(shared, (std::set<bool>{false, true}));
  EXPECT_EQ(ticks.Shared(), ThreadChoice::kTrials);
  unsigned count = 0;
  ticks.Do(nullptr, [&] { ++count; });
  WorkerPool one(1);
  ticks.Do(&one, [&] { ++count; });
  EXPECT_EQ(count, 2U);
}

}  // namespace
}  // namespace swarmanoid
