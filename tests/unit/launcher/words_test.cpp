// The small languages of the command: control requests, templates.
#include <gmock/gmock.h>

#include "common/run/run_options.h"
#include "launcher/command/control_words.h"
#include "launcher/command/sub_command.h"
#include "launcher/templates/template_files.h"
#include "simulation/load.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

std::string ErrorOf(const std::vector<std::string>& words)
{
  return test::MessageOf<UsageError>([&] { ParseControlWords(words); });
}

ControlOrder OrderOf(const std::vector<std::string>& words) { return ParseControlWords(words).order; }

TEST(ControlWords, TakeTheNameOfTheExperimentIfItIsGiven)
{
  EXPECT_EQ(ParseControlWords({"pause"}).experiment, "");
  EXPECT_EQ(ParseControlWords({"diffusion_10", "pause"}).experiment, "diffusion_10");
  EXPECT_EQ(ParseControlWords({"stop", "stop"}).experiment, "stop");
  EXPECT_EQ(ParseControlWords({"stop", "stop"}).order, ControlOrder{"stop"});
  EXPECT_EQ(ParseControlWords({"world", "remove", "fb0"}).experiment, "world");
}

TEST(ControlWords, AnEntityMayBeCalledLikeAVerb)
{
  EXPECT_EQ(OrderOf({"move", "stop", "-1,2,0"}).Get<std::string>("entity"), "stop");
  EXPECT_EQ(OrderOf({"add", "remove", "1,2,0"}).verb, "add");
  EXPECT_EQ(OrderOf({"add", "remove", "1,2,0"}).Get<std::string>("entity"), "remove");
}

TEST(ControlWords, APoseIsAllWordsThatAreLeft)
{
  for (const auto& words : {std::vector<std::string>{"move", "fb0", "1,2,0,0,0,90"},
                            {"world", "move", "fb0", "1", "2", "0", "0", "0", "90"}})
    EXPECT_THAT(OrderOf(words).Get<std::vector<double>>("pose"), ElementsAre(1, 2, 0, 0, 0, 90));
}

TEST(ControlWords, TheSeedOfAResetIsAnOption)
{
  EXPECT_EQ(OrderOf({"reset"}).arguments.size(), 0U);
  EXPECT_EQ(ParseControlWords({"world", "reset"}, {{"seed", "9007199254740993"}}).order.Get<std::int64_t>("seed"),
            9007199254740993);
  EXPECT_THROW(ParseControlWords({"pause"}, {{"seed", "7"}}), UsageError);
  EXPECT_THAT(ErrorOf({"reset", "7"}), HasSubstr("write reset [--seed N]"));
}

TEST(ControlWords, MisspeltVerbsAreNamed)
{
  EXPECT_THAT(ErrorOf({"pause", "diffusion_10"}), HasSubstr("swarmanoid control diffusion_10 pause"));
  EXPECT_THAT(ErrorOf({"paus"}), HasSubstr("did you mean 'pause'?"));
  EXPECT_THAT(ErrorOf({"spede", "2"}), HasSubstr("there is no request 'spede'"));
  EXPECT_THAT(ErrorOf({"spede", "2"}), HasSubstr("did you mean 'speed'?"));
  EXPECT_THAT(ErrorOf({"diffusion_10", "spede", "2"}), HasSubstr("did you mean 'speed'?"));
  EXPECT_THAT(ErrorOf({"mvoe", "fb0", "1,2,0"}), HasSubstr("did you mean 'move'?"));
  EXPECT_THAT(ErrorOf({"shares"}), HasSubstr("there is no request 'shares'"));
}

TEST(ControlWords, ErrorsSayTheRightForm)
{
  EXPECT_THAT(ErrorOf({"move-host"}), HasSubstr("write move-host N [MACHINE]"));
  EXPECT_THAT(ErrorOf({"move-host", "ground"}), HasSubstr("'ground' is no number of a controller host"));
  EXPECT_THAT(ErrorOf({"step", "0"}), HasSubstr("0 is no number of ticks from 1 to"));
  EXPECT_THAT(ErrorOf({"step", "1.5"}), HasSubstr("write step [N]"));
  EXPECT_THAT(ErrorOf({"speed", "-1"}), HasSubstr("-1 is no multiple of real time from 0"));
  EXPECT_THAT(ErrorOf({"move", "fb0", "1,2"}), HasSubstr("write move ENTITY X,Y,Z[,A,B,G]"));
  EXPECT_THAT(ErrorOf({"pause", "now"}), HasSubstr("'now'"));
  EXPECT_THAT(ErrorOf({"world", "remove", "fb0", "1,2,0"}), HasSubstr("write remove ENTITY"));
}

TEST(ControlWords, ARunThatGivesNoAnswerIsTold)
{
  EXPECT_THAT(WhyNoAnswer(std::nullopt, 0, false), HasSubstr("nothing is heard of it"));
  EXPECT_THAT(WhyNoAnswer(std::nullopt, 7, false), HasSubstr("give the --key of this run"));
  EXPECT_THAT(WhyNoAnswer(std::nullopt, 7, true), HasSubstr("give its --key instead of --insecure"));
  RunStatus status;
  status.tick = 12;
  EXPECT_EQ(WhyNoAnswer(status, 0, false), "; it is at tick 12");
  status.processes.resize(3);
  status.processes[1].name = "engine 'ground'";
  status.processes[1].late_s = 3;
  status.processes[2].name = "controller host 0";
  status.processes[2].late_s = 2;
  status.processes[2].doing = "runs the controller of fb_3";
  EXPECT_EQ(WhyNoAnswer(status, 7, false),
            "; it is at tick 12 and waits for engine 'ground' since 3 s, controller host 0 since 2 s (runs the "
            "controller of fb_3)");
}

TEST(ControlWords, MovesOfWorkersHaveMorePatience)
{
  EXPECT_EQ(PatienceFor({"pause"}, 5), 5);
  EXPECT_EQ(PatienceFor({"machines"}, 5), 5);
  EXPECT_EQ(PatienceFor(OrderOf({"drain", "alpha"}), 5), 600);
  EXPECT_EQ(PatienceFor(OrderOf({"hosts", "again"}), 900), 900);
}

TEST(TemplateFiles, FillInTheNames)
{
  EXPECT_EQ(ClassName("wall_follower_2"), "CWallFollower2");
  EXPECT_EQ(BehaviorClassName("bt_footbot_stop"), "CBTFootbotStop");
  EXPECT_EQ(BehaviorClassName("stop"), "CBTStop");
  EXPECT_EQ(FilledIn("class @class@; // @name@.h @name@", {{"name", "a_b"}, {"class", "CAB"}}),
            "class CAB; // a_b.h a_b");
  EXPECT_TRUE(IsClassName("CWall_2"));
  for (const char* name : {"", "wall", "2Wall", "C Wall", "C-W", "C;"}) EXPECT_FALSE(IsClassName(name)) << name;
  EXPECT_TRUE(IsIdentifier("wall_follower2"));
  for (const char* name : {"", "2nd", "Wall", "a-b", "a b", "_a", "../a"}) EXPECT_FALSE(IsIdentifier(name)) << name;
}

TEST(SplitSetting, NeedsAPath)
{
  EXPECT_EQ(SplitSetting("a.b=c=d"), (std::pair<std::string, std::string>("a.b", "c=d")));
  EXPECT_EQ(SplitSetting("a="), (std::pair<std::string, std::string>("a", "")));
  EXPECT_THROW(SplitSetting("=c"), UsageError);
  EXPECT_THROW(SplitSetting("a"), UsageError);
}

}  // namespace
}  // namespace swarmanoid
