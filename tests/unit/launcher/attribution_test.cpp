// Attribution of a failure from the reports and the ends of processes.
#include "launcher/supervision/attribution.h"

#include <gmock/gmock.h>
#include <signal.h>

#include "common/errors/exit_codes.h"

namespace swarmanoid
{
namespace
{

ActivityRecord Record(EndReason end, bool complete = false)
{
  ActivityRecord record;
  record.taken = true;
  record.tick = 50;
  record.end = end;
  record.complete = complete;
  if (end == EndReason::kFailed) record.cause = "the cause";
  return record;
}

constexpr ProcessEnd Exited(int code) { return {code, 0}; }
constexpr ProcessEnd Killed(int number) { return {0, number}; }

TEST(Attribution, AFailureThatIsToldCountsBeforeTheProcessEnds)
{
  EXPECT_EQ(EvidenceOf(std::nullopt, Record(EndReason::kFailed, true)), Evidence::kDeath);
  EXPECT_EQ(EvidenceOf(std::nullopt, Record(EndReason::kFailed)), Evidence::kFailure);
  EXPECT_EQ(EvidenceOf(std::nullopt, Record(EndReason::kOthers)), Evidence::kNone);
}

TEST(Attribution, OneThatEndsForAnotherIsAConsequence)
{
  EXPECT_EQ(EvidenceOf(Exited(4), Record(EndReason::kOthers)), Evidence::kConsequence);
  EXPECT_EQ(EvidenceOf(Exited(kExitCutOff), Record(EndReason::kUnknown)), Evidence::kConsequence);
  EXPECT_EQ(EvidenceOf(Exited(6), ActivityRecord()), Evidence::kConsequence);
}

TEST(Attribution, OneThatDiedIsReplacedAndOneThatSaysWhatIsWrongIsNot)
{
  EXPECT_TRUE(MayBeReplaced(Killed(SIGKILL), Record(EndReason::kUnknown), false));
  EXPECT_TRUE(MayBeReplaced(Killed(SIGKILL), Record(EndReason::kDone), false)) << "the end may be unheard";
  EXPECT_FALSE(MayBeReplaced(Exited(0), Record(EndReason::kDone), false));
  EXPECT_TRUE(MayBeReplaced(Exited(4), Record(EndReason::kDied), false));
  EXPECT_FALSE(MayBeReplaced(Exited(4), Record(EndReason::kFailed), false));
  EXPECT_FALSE(MayBeReplaced(Exited(6), Record(EndReason::kOthers), false));
  EXPECT_TRUE(MayBeReplaced(Killed(SIGKILL), Record(EndReason::kOthers), false)) << "given up as it gave up the server";
  EXPECT_TRUE(MayBeReplaced(Exited(128 + SIGKILL), Record(EndReason::kOthers), true));
  EXPECT_TRUE(MayBeReplaced(Exited(kExitCutOff), Record(EndReason::kOthers), false));
  // For a process on another machine, only the exit code is known.
  EXPECT_TRUE(MayBeReplaced(Exited(kExitCutOff), ActivityRecord(), true));
  EXPECT_TRUE(MayBeReplaced(Exited(255), ActivityRecord(), true));
  EXPECT_FALSE(MayBeReplaced(Exited(kExitInterrupted), ActivityRecord(), true));
  EXPECT_FALSE(MayBeReplaced(Exited(255), ActivityRecord(), false));
}

TEST(Attribution, OnlyWhatSomebodyElseDidIsKilling)
{
  EXPECT_TRUE(WasKilled(Killed(SIGKILL), false));
  EXPECT_FALSE(WasKilled(Killed(SIGSEGV), false));
  EXPECT_TRUE(WasKilled(Exited(128 + SIGKILL), true));
  EXPECT_FALSE(WasKilled(Exited(128 + SIGKILL), false));
}

TEST(Attribution, AnEndByZeroIsGoodOnlyIfTheWorkIsSaidToBeDone)
{
  EXPECT_EQ(EvidenceOf(Exited(0), Record(EndReason::kDone)), Evidence::kEarlyEnd);
  EXPECT_EQ(EvidenceOf(Exited(0), Record(EndReason::kUnknown)), Evidence::kDeath);
  EXPECT_EQ(EvidenceOf(Exited(0), ActivityRecord()), Evidence::kEarlyEnd) << "a process of another machine";
}

TEST(Attribution, WhoeverSaidWhatIsWrongIsNotStartedAgain)
{
  for (const ProcessEnd& died : {Killed(SIGKILL), Killed(SIGSEGV), Exited(0), Exited(1), Exited(137)})
  {
    EXPECT_TRUE(MayBeReplaced(died, Record(EndReason::kUnknown), false)) << died.Text();
    EXPECT_TRUE(MayBeReplaced(died, Record(EndReason::kDied, true), false)) << died.Text();
  }
  EXPECT_TRUE(MayBeReplaced(Exited(137), ActivityRecord(), true));
  EXPECT_FALSE(MayBeReplaced(Exited(137), ActivityRecord(), false)) << "it was not one of our programs";
  for (const EndReason reason : {EndReason::kDone, EndReason::kFailed, EndReason::kInvalid, EndReason::kOthers})
    EXPECT_FALSE(MayBeReplaced(Exited(4), Record(reason), false));
  // A usage error and an invalid file count, even if the page does not report them.
  for (const int code : {2, 3})
    for (const bool elsewhere : {false, true})
      EXPECT_FALSE(MayBeReplaced(Exited(code), Record(EndReason::kUnknown), elsewhere)) << code;
}

TEST(Attribution, DeathsCountUntilATickAfterThatOfTheLastOneIsDone)
{
  DeathCount deaths;
  ActivityRecord record = Record(EndReason::kUnknown);
  EXPECT_TRUE(deaths.Add(49, record, 2));
  EXPECT_TRUE(deaths.Add(50, record, 2));
  EXPECT_FALSE(deaths.Add(51, record, 2)) << "tick 50 itself is the 51st, and its report may come late";
  EXPECT_TRUE(deaths.Add(52, record, 2));
  // All processes have started again from an earlier tick.
  record.tick = 40;
  EXPECT_TRUE(deaths.Add(40, record, 2));
  EXPECT_FALSE(deaths.Add(52, record, 2));
}

TEST(Attribution, OneThatDiesLikeTheLastTimeDiesForGood)
{
  DeathCount deaths;
  ActivityRecord record = Record(EndReason::kDied);
  record.step = ActivityStep::kDestroy;
  EXPECT_TRUE(deaths.Add(30, record, 9));
  EXPECT_FALSE(deaths.Add(51, record, 9)) << "the server's report of the last tick came between the two deaths";
  record.number = 1;
  EXPECT_TRUE(deaths.Add(51, record, 9));
}

TEST(Attribution, AKilledProcessIsToldByWhomItRan)
{
  ActivityRecord record = Record(EndReason::kUnknown);
  record.kind = Actor::kRobot;
  record.number = 3;
  record.step = ActivityStep::kControlStep;
  EXPECT_EQ(EvidenceOf(Killed(SIGKILL), record), Evidence::kDeath);
  const auto actor_of = [](Actor::Kind kind, std::uint32_t number)
  {
    EXPECT_EQ(kind, Actor::kRobot);
    EXPECT_EQ(number, 3U);
    return Actor{kind, number, "fb_3", "diffusion"};
  };
  EXPECT_EQ(
      FailureText({"controller host 0", kHere, Killed(SIGKILL), record}, 51, actor_of, false),
      "controller host 0 was killed by signal 9 (Killed), during robot 'fb_3', controller 'diffusion': ControlStep at "
      "tick 50");
  EXPECT_NE(
      FailureText({"controller host 0", kHere, Killed(SIGKILL), record}, 51, actor_of, true).find("memory was short"),
      std::string::npos);
}

TEST(Attribution, TheCauseThatAProcessTellsIsTheHeadline)
{
  EXPECT_EQ(FailureText({"controller host 0", kHere, std::nullopt, Record(EndReason::kFailed, true)}, 51, {}, false),
            "the cause");
}

TEST(Attribution, TheTickIsThatOfTheProcessWhereItTellsOne)
{
  EXPECT_EQ(FailureText({"engine 'ground'", kHere, Exited(1), Record(EndReason::kUnknown)}, 51, {}, false),
            "engine 'ground' ended with exit code 1 at tick 50");
}

TEST(Attribution, WithoutAWordTheTickIsTheServers)
{
  EXPECT_EQ(FailureText({"engine 'ground'", "alpha", Exited(4), ActivityRecord()}, 51, {}, false),
            "engine 'ground' on alpha ended with exit code 4 at tick 51");
  EXPECT_THAT(FailureText({"engine 'ground'", "alpha", Exited(255), ActivityRecord()}, 51, {}, false),
              testing::HasSubstr("by ssh: the connection failed"));
  EXPECT_THAT(FailureText({"engine 'ground'", kHere, Exited(255), ActivityRecord()}, 51, {}, false),
              testing::Not(testing::HasSubstr("ssh")));
  EXPECT_EQ(FailureText({"engine 'ground'", kHere, Exited(1), ActivityRecord()}, 51, {}, false),
            "engine 'ground' ended with exit code 1 at tick 51");
}

}  // namespace
}  // namespace swarmanoid
