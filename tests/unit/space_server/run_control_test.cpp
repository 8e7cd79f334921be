// RunControl: when the next tick may start, on a clock of the test.
#include "space_server/run_control.h"

#include <gtest/gtest.h>

#include <memory>

#include "common/messages/control_verbs.h"

namespace swarmanoid
{
namespace
{

using std::chrono::hours;
using std::chrono::milliseconds;

// An empty arena with ticks of 100 ms, at real time.
class Pace : public ::testing::Test
{
protected:
  Pace()
  {
    experiment_.arena_size = {1, 1, 1};
    experiment_.clock_tick_ms = 100;
    server_ = std::make_unique<SpaceServer>(experiment_, assignment_, ".");
    RunControlSetup setup;
    setup.real_time_factor = 1;
    control_ = std::make_unique<RunControl>(experiment_, setup,
                                            [](const ControlRequestMessage&, bool done, std::uint64_t,
                                               const std::string& text) { EXPECT_TRUE(done) << text; });
    control_->Start(0, now_);
  }
  void Ask(const ControlOrder& order)
  {
    control_->Ask({order});
    control_->Work(*server_);
  }
  RunControl::Decision Decide() { return control_->Decide(server_->Space().GetTick(), now_); }
  // The next tick starts now, and ends in no time.
  void Tick()
  {
    ASSERT_TRUE(Decide().go) << "tick " << server_->Space().GetTick();
    server_->Advance({}, {});
    control_->Work(*server_);
  }
  // The next tick may start after this time, and not before.
  void ExpectDueAfter(milliseconds time)
  {
    const RunControl::Decision decision = Decide();
    EXPECT_FALSE(decision.go) << "it hurries";
    EXPECT_EQ(decision.due, now_ + time);
    now_ += time;
    EXPECT_TRUE(Decide().go);
  }

  Experiment experiment_;
  Assignment assignment_;
  std::unique_ptr<SpaceServer> server_;
  std::unique_ptr<RunControl> control_;
  RunControl::Clock::time_point now_{hours(1)};
};

TEST_F(Pace, TicksStartAtTheirTimes)
{
  for (int k = 0; k < 3; ++k)
  {
    Tick();
    ExpectDueAfter(milliseconds(100));
  }
}

TEST_F(Pace, TheTimeOfAPauseIsNotMadeUpFor)
{
  Tick();
  Ask({"pause"});
  EXPECT_FALSE(Decide().go);
  EXPECT_FALSE(Decide().due.has_value()) << "a paused run waits for a request, not for a time";
  now_ += hours(1);
  EXPECT_FALSE(Decide().go);
  Ask({"resume"});
  Tick();
  ExpectDueAfter(milliseconds(100));
}

TEST_F(Pace, StepsOfAPausedRunKeepTheirPace)
{
  Ask({"pause"});
  for (int k = 0; k < 2; ++k)
  {
    now_ += hours(1);
    Ask({"step", {{"ticks", std::int64_t{2}}}});
    Tick();
    ExpectDueAfter(milliseconds(100));
    Tick();
    EXPECT_TRUE(control_->Paused());
    EXPECT_FALSE(Decide().go);
  }
}

TEST_F(Pace, AnotherSpeedHoldsFromTheTickAtWhichItIsAsked)
{
  Tick();
  now_ += milliseconds(100);
  Tick();
  Ask({"speed", {{"factor", 4.0}}});
  Tick();
  ExpectDueAfter(milliseconds(25));
  Ask({"speed", {{"factor", 0.0}}});
  for (int k = 0; k < 3; ++k) Tick();
  Ask({"speed", {{"factor", 0.5}}});
  Tick();
  ExpectDueAfter(milliseconds(200));
}

// A new verb is a row of the table and an action.
TEST(RunControlActions, EachVerbOfAMemberIsExecutedOrRefusedForAReasonOfItsOwn)
{
  Experiment experiment;
  experiment.arena_size = {1, 1, 1};
  experiment.clock_tick_ms = 100;
  const Assignment assignment;
  for (const ControlVerb& verb : ControlVerbs())
  {
    std::map<std::string, std::string> options;
    std::vector<std::string> words;
    for (const ControlParameter& parameter : verb.parameters)
      if (parameter.is_option)
        options[parameter.name] = "1";
      else
        words.emplace_back(parameter.type == ArgumentType::kPose     ? "1,1,0"
                           : parameter.type == ArgumentType::kChange ? "+1"
                           : parameter.type == ArgumentType::kChoice ? parameter.choices[0]
                                                                     : "1");
    SpaceServer server(experiment, assignment, ".");
    std::vector<std::string> replies;
    RunControl control(experiment, {},
                       [&](const ControlRequestMessage&, bool, std::uint64_t, const std::string& text)
                       { replies.push_back(text); });
    control.Ask({ParseOrder(verb, options, words)});
    control.Work(server);
    control.Ended(1);
    ASSERT_EQ(replies.size(), 1U) << verb.name;
    EXPECT_EQ(replies[0].starts_with("there is no request"), verb.who > Asker::kMember) << replies[0];
  }
}

}  // namespace
}  // namespace swarmanoid
