// WorkerMembership: each event in each phase, the table in the documentation, and what follows from time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/membership/worker_membership.h"
#include "common/errors/exit_codes.h"
#include "tests/unit/bus/phase_table.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Phase = WorkerMembership::Phase;
using Event = WorkerMembership::Event;
using Action = WorkerMembership::Action;

constexpr std::uint64_t kRun = 5;
const std::string kServer = "here:1";
const std::string kThis = "here:2";

TEST(WorkerMembership, TheDocumentationHasTheTableOfTheCode) { ExpectTableInDocumentation<WorkerMembership>(); }

TEST(WorkerMembership, EachEventInEachPhaseLeadsToAPhaseFromWhichTheProcessCanLeave)
{
  for (std::size_t phase = 0; phase < WorkerMembership::kPhases.size(); ++phase)
    for (std::size_t event = 0; event < WorkerMembership::kEvents.size(); ++event)
    {
      const Phase from = static_cast<Phase>(phase);
      const Phase next = WorkerMembership::Transition(from, static_cast<Event>(event)).phase;
      const auto text = fmt::format("{} in {}", WorkerMembership::kEvents[event], WorkerMembership::kPhases[phase]);
      if (from >= Phase::kLeaving)
      {
        EXPECT_GE(next, from) << text;
      }
      const Phase left = WorkerMembership::Transition(next, Event::kWorkEnded).phase;
      EXPECT_GE(left, Phase::kLeaving) << text;
      EXPECT_EQ(WorkerMembership::Transition(left, Event::kAnswered).phase, Phase::kLeft) << text;
      EXPECT_EQ(WorkerMembership::Transition(left, Event::kServerGone).phase, Phase::kLeft) << text;
    }
}

TEST(WorkerMembership, AStrongerEndReplacesAWeakerOneAndNeverTheOtherWay)
{
  constexpr Event kEnds[] = {Event::kBusStuck,     Event::kServerGone,  Event::kServerLeft,
                             Event::kServerFailed, Event::kInterrupted, Event::kOwnFailure};
  for (std::size_t first = 0; first < std::size(kEnds); ++first)
    for (std::size_t second = 0; second < std::size(kEnds); ++second)
    {
      const Phase end = WorkerMembership::Transition(Phase::kStepping, kEnds[first]).phase;
      const Phase alone = WorkerMembership::Transition(Phase::kStepping, kEnds[second]).phase;
      EXPECT_EQ(WorkerMembership::Transition(end, kEnds[second]).phase, std::max(end, alone));
    }
}

class AWorker : public testing::Test
{
protected:
  AWorker()
  {
    EXPECT_EQ(worker_.HeardWorld(kServer, true, now_), Action::kSayJoin);
    EXPECT_EQ(worker_.On(Event::kPrepared, now_), Action::kSayReady);
  }

  Action Look(std::chrono::milliseconds after, WorkerMembership::Sight sight = {})
  {
    now_ += after;
    return worker_.Look(sight, now_);
  }
  void HearServer(const std::string& process, const std::string& error, std::uint64_t run = kRun)
  {
    worker_.Heard({run, 0, "space server", process, error}, kThis, kRun, now_);
  }

  WorkerMembership worker_;
  WorkerMembership::Time now_{};
};

TEST_F(AWorker, SaysEachSecondThatItIsReadyUntilATickHasPassedAndAfterTheLastOne)
{
  EXPECT_EQ(Look(999ms), Action::kNone);
  EXPECT_EQ(Look(1ms), Action::kSayReady);
  worker_.AtTick(7, now_);
  EXPECT_EQ(Look(1s), Action::kSayReady);
  worker_.AtTick(8, now_);
  EXPECT_EQ(worker_.Now(), Phase::kStepping);
  EXPECT_EQ(Look(10s), Action::kNone);
  worker_.On(Event::kLastTick, now_);
  EXPECT_EQ(Look(1s), Action::kSayReady);
}

// The server does not answer a process whose Join it has not received. Fast DDS 2.9 may lose the Join while it matches
// the reader.
TEST(WorkerMembership, RepeatsItsJoinWhileItBuildsItsPartOfTheWorld)
{
  WorkerMembership worker;
  WorkerMembership::Time now{};
  worker.HeardWorld(kServer, true, now);
  EXPECT_EQ(worker.Look({}, now + 999ms), Action::kNone);
  EXPECT_EQ(worker.Look({}, now + 1000ms), Action::kSayJoin);
}

// Ticks that a replacement does again are none of the run.
TEST_F(AWorker, DoesNotStepBecauseOfTicksBeforeItWasReady)
{
  WorkerMembership replacement;
  replacement.HeardWorld(kServer, true, now_);
  for (std::uint64_t tick = 3; tick < 6; ++tick) replacement.AtTick(tick, now_);
  replacement.On(Event::kPrepared, now_);
  replacement.AtTick(6, now_);
  EXPECT_EQ(replacement.Now(), Phase::kReady);
  EXPECT_EQ(replacement.Look({}, now_ + 1s), Action::kSayReady);
}

TEST_F(AWorker, RepeatsItsLeaveMoreAndMoreSeldomUntilItIsAnswered)
{
  worker_.On(Event::kLastTick, now_);
  EXPECT_EQ(worker_.On(Event::kWorkEnded, now_), Action::kSayLeave);
  for (const auto wait : {100ms, 200ms, 400ms, 800ms, 1000ms, 1000ms})
  {
    EXPECT_EQ(Look(wait - 1ms), Action::kNone) << wait.count();
    EXPECT_EQ(Look(1ms), Action::kSayLeave) << wait.count();
  }
  HearServer("another:3", "");
  HearServer(kThis, "", kRun + 1);
  EXPECT_EQ(worker_.Now(), Phase::kLeaving);
  HearServer(kThis, "");
  EXPECT_EQ(worker_.Now(), Phase::kLeft);
}

TEST_F(AWorker, DoesNotWaitForTheAnswerOfAServerThatHasGone)
{
  worker_.On(Event::kWorkEnded, now_);
  Look(0ms, {.server_is_gone = true});
  EXPECT_EQ(worker_.Now(), Phase::kLeft);
}

TEST_F(AWorker, WaitsASecondForTheAnswerIfItIsInterrupted)
{
  Look(0ms, {.is_interrupted = true});
  EXPECT_EQ(worker_.Text(), "interrupted by a signal");
  worker_.On(Event::kWorkEnded, now_);
  Look(1000ms, {.is_interrupted = true});
  EXPECT_EQ(worker_.Now(), Phase::kLeaving);
  Look(1ms, {.is_interrupted = true});
  EXPECT_EQ(worker_.Now(), Phase::kLeft);
  EXPECT_EQ(worker_.ExitCode(), kExitInterrupted);
}

TEST_F(AWorker, WaitsForTheLockOfADeadProcessForAsLongAsNoTickPasses)
{
  constexpr WorkerMembership::Sight kBroken{.bus_is_broken = true};
  worker_.AtTick(1, now_);
  Look(0ms, kBroken);
  Look(2s, kBroken);
  worker_.AtTick(2, now_);
  Look(1ms, kBroken);
  Look(2s, kBroken);
  EXPECT_EQ(worker_.Now(), Phase::kStepping);
  Look(1ms, kBroken);
  EXPECT_EQ(worker_.Now(), Phase::kStuck);
  EXPECT_EQ(worker_.ExitCode(), kExitStuck);
}

TEST_F(AWorker, EndsAsTheServerSays)
{
  HearServer("another:3", "controller host 0 died");
  EXPECT_FALSE(worker_.HasEnded());
  HearServer("", "controller host 0 died");
  EXPECT_EQ(worker_.Now(), Phase::kRunFailed);
  EXPECT_EQ(worker_.Text(), "controller host 0 died");
  EXPECT_EQ(worker_.ExitCode(), kExitOthersFailed);
  EXPECT_EQ(worker_.On(Event::kWorkEnded, now_), Action::kNone);
  EXPECT_EQ(worker_.Now(), Phase::kLeft);
}

TEST_F(AWorker, KeepsItsOwnFailureWhateverTheServerSaysLater)
{
  worker_.On(Event::kOwnFailure, now_, "out of paper");
  HearServer("", "engine 'ground' failed: out of paper");
  EXPECT_EQ(worker_.Text(), "out of paper");
  EXPECT_EQ(worker_.Reason(), EndReason::kFailed);
  EXPECT_EQ(worker_.On(Event::kWorkEnded, now_), Action::kSayLeave);
  EXPECT_EQ(worker_.ExitCode(), kExitProcessFailed);
}

TEST_F(AWorker, ThatObservesGoesOnWithTheNextServer)
{
  worker_.Observe();
  worker_.On(Event::kServerGone, now_);
  EXPECT_EQ(worker_.ExitCode(), kExitProcessFailed);
  EXPECT_EQ(worker_.JoinNext("here:9", true, now_), Action::kSayReady);
  EXPECT_EQ(worker_.Server(), "here:9");
  EXPECT_FALSE(worker_.End());
}

TEST_F(AWorker, HearsWhichOthersHaveLeft)
{
  worker_.Heard({kRun, 8, "engine 'ground'", "here:4", ""}, kThis, kRun, now_);
  worker_.Heard({kRun, 8, "engine 'air'", "here:5", "out of memory"}, kThis, kRun, now_);
  EXPECT_TRUE(worker_.HasLeft("engine 'ground'", 8));
  EXPECT_FALSE(worker_.HasLeft("engine 'ground'", 9));
  EXPECT_FALSE(worker_.HasLeft("engine 'air'", 0));
}

TEST(WorkerMembership, HearsThatAShareHasEndedBeforeItHearsAWorld)
{
  WorkerMembership observer;
  observer.Heard({0, 0, "space server", "", "the share has ended"}, kThis, 0, {});
  EXPECT_EQ(observer.Now(), Phase::kRunFailed);
  EXPECT_EQ(observer.Text(), "the share has ended");
}

}  // namespace
}  // namespace swarmanoid
