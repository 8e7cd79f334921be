// ServerMembership: each event in each phase, the table in the documentation, and which process may join under which
// name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/membership/server_membership.h"
#include "tests/unit/bus/phase_table.h"

namespace swarmanoid
{
namespace
{

using MemberPhase = ServerMembership::Phase;
using MemberEvent = ServerMembership::Event;
using Verdict = ServerMembership::Verdict;

constexpr std::uint64_t kRunOfMembers = 5;
const std::string kEngine = "engine 'ground'";
const std::string kHost = "controller host 0";

TEST(ServerMembership, TheDocumentationHasTheTableOfTheCode) { ExpectTableInDocumentation<ServerMembership>(); }

TEST(ServerMembership, NoEventBringsAProcessBackThatHasLeft)
{
  for (const MemberPhase left : {MemberPhase::kDone, MemberPhase::kGone})
    for (std::size_t event = 0; event < ServerMembership::kEvents.size(); ++event)
      EXPECT_GE(ServerMembership::Transition(left, static_cast<MemberEvent>(event)).phase, left)
          << ServerMembership::kEvents[event];
}

class ARun : public testing::Test
{
protected:
  Verdict Join(const std::string& process, const std::string& name, bool ready, std::uint32_t incarnation = 0)
  {
    return run_.Heard(JoinMessage{process, kProtocolVersion, kRunOfMembers, name, ready, incarnation});
  }
  void Leave(const std::string& process, const std::string& name, std::uint64_t tick, const std::string& error = "")
  {
    run_.Heard(LeaveMessage{kRunOfMembers, tick, name, process, error});
  }

  ServerMembership run_{kRunOfMembers, {kEngine, kHost}};
};

TEST_F(ARun, TakesEachProcessOnceAndRefusesASecondOneOfItsName)
{
  EXPECT_EQ(Join("a:1", kEngine, false), Verdict::kTaken);
  EXPECT_EQ(run_.Of(kEngine).phase, MemberPhase::kJoined);
  EXPECT_EQ(Join("a:1", kEngine, false), Verdict::kNothingNew);
  EXPECT_EQ(Join("a:1", kEngine, true), Verdict::kTaken);
  EXPECT_EQ(run_.Of(kEngine).phase, MemberPhase::kReady);
  EXPECT_EQ(Join("a:1", kEngine, true), Verdict::kNothingNew);
  EXPECT_EQ(Join("a:2", kEngine, false), Verdict::kNameTaken);
  EXPECT_EQ(Join("a:2", kEngine, false, 1), Verdict::kNameTaken);  // no replacements are awaited
}

TEST_F(ARun, TakesAReplacementAndRefusesItsPredecessor)
{
  run_.AwaitReplacements();
  Join("a:1", kEngine, true);
  run_.Missed("a:1", true);
  EXPECT_EQ(run_.Latest().lost, std::vector<std::string>{kEngine});
  EXPECT_EQ(Join("a:2", kEngine, true, 1), Verdict::kTaken);
  EXPECT_EQ(run_.Latest().replaced, (std::vector<std::pair<std::string, std::uint32_t>>{{kEngine, 1}}));
  EXPECT_EQ(Join("a:1", kEngine, true), Verdict::kNameTaken);
  EXPECT_FALSE(run_.Failure());
}

TEST_F(ARun, FailsWithTheFirstProcessThatIsMissed)
{
  Join("a:1", kEngine, true);
  Join("a:2", kHost, true);
  run_.Missed("a:2", true);
  run_.Missed("a:1", false);
  EXPECT_EQ(run_.Failure(), "controller host 0 does not answer any more (process a:2)");
}

TEST_F(ARun, IgnoresTheEndOfAProcessThatIsToBeReplaced)
{
  run_.AwaitReplacements();
  Join("a:1", kEngine, true);
  run_.Release(kEngine);
  Leave("a:1", kEngine, 3, "killed");
  run_.Missed("a:1", true);
  EXPECT_FALSE(run_.Failure());
  EXPECT_TRUE(run_.Latest().lost.empty());
  EXPECT_EQ(run_.Latest().answers.size(), 1U);
  EXPECT_EQ(Join("a:2", kEngine, true, 1), Verdict::kTaken);
}

// A region may replace one that was killed after its engine had done its work.
TEST_F(ARun, TellsAReplacementWhichOthersHaveLeftAsOftenAsItJoins)
{
  run_.AwaitReplacements();
  Join("a:1", kEngine, true);
  Join("a:2", kHost, true);
  Leave("a:1", kEngine, 9);
  EXPECT_EQ(run_.Latest().left, std::vector<std::string>{kEngine});
  for (int time = 0; time < 2; ++time)
  {
    run_.Latest().answers.clear();
    Join("a:3", kHost, false, 1);
    ASSERT_EQ(run_.Latest().answers.size(), 1U);
    EXPECT_EQ(run_.Latest().answers.back().name, kEngine);
    EXPECT_EQ(run_.Latest().answers.back().tick, 9U);
  }
}

// A process that leaves repeats Join and Leave until it is answered. Answers for each would be as many as the cube of
// the number of processes.
TEST_F(ARun, AnswersOnceWhatIsAskedAgain)
{
  run_.AwaitReplacements();
  for (const auto& [process, name] : {std::pair{"a:1", kEngine}, {"a:2", kHost}}) Join(process, name, true);
  for (int time = 0; time < 3; ++time)
    for (const auto& [process, name] : {std::pair{"a:1", kEngine}, {"a:2", kHost}})
    {
      Join(process, name, false);
      Leave(process, name, 9);
    }
  std::vector<std::string> answered;
  for (const LeaveMessage& answer : run_.Latest().answers) answered.push_back(answer.name + " to " + answer.process);
  EXPECT_THAT(answered,
              testing::UnorderedElementsAre("space server to a:1", kEngine + " to a:1", "space server to a:2"));
}

TEST_F(ARun, AnswersTheLeaveOfAProcessThatIsNoMemberAndForgetsIt)
{
  Join("a:7", "attached visualiser", true);
  EXPECT_EQ(run_.Attached().size(), 1U);
  Leave("a:7", "attached visualiser", 1, "out of paper");
  run_.Missed("a:7", false);
  EXPECT_EQ(run_.Latest().answers.size(), 1U);
  EXPECT_TRUE(run_.Attached().empty());
  EXPECT_FALSE(run_.Failure());
}

// Otherwise it would go, and the run would wait for its predecessor.
TEST_F(ARun, DoesNotAnswerTheLeaveOfAReplacementWhoseJoinWasLost)
{
  run_.AwaitReplacements();
  Join("a:1", kEngine, true);
  run_.Missed("a:1", true);
  Leave("a:2", kEngine, 3);
  EXPECT_TRUE(run_.Latest().answers.empty());
  Join("a:2", kEngine, true, 1);
  Leave("a:2", kEngine, 3);
  Leave("a:1", kEngine, 2);  // its predecessor comes back, and may go
  EXPECT_EQ(run_.Latest().answers.size(), 2U);
  EXPECT_EQ(run_.Of(kEngine).phase, MemberPhase::kDone);
}

TEST_F(ARun, FailsByNothingOnceItIsOver)
{
  Join("a:1", kEngine, true);
  Join("a:2", kHost, true);
  run_.End();
  run_.Missed("a:1", true);
  Leave("a:2", kHost, 3, "out of paper");
  EXPECT_TRUE(run_.HeardBad("a:2", "sent a bad message"));
  EXPECT_FALSE(run_.Failure());
}

}  // namespace
}  // namespace swarmanoid
