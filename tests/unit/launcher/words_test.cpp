// The small languages of the command: control requests, templates.
#include <gmock/gmock.h>

#include "common/run/run_settings.h"
#include "launcher/command/sub_command.h"
#include "launcher/control_words.h"
#include "launcher/template_files.h"
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
  return test::MessageOf<UsageError>([&] { ParseControlRequest(words); });
}

TEST(ControlRequest, TakesTheNameWhereItIsGiven)
{
  EXPECT_EQ(ParseControlRequest({"pause"}).experiment, "");
  EXPECT_EQ(ParseControlRequest({"diffusion_10", "pause"}).experiment, "diffusion_10");
  EXPECT_EQ(ParseControlRequest({"stop", "stop"}).experiment, "stop");
  EXPECT_EQ(ParseControlRequest({"stop", "stop"}).verb, "stop");
}

TEST(ControlRequest, ReadsNumbers)
{
  EXPECT_THAT(ParseControlRequest({"step"}).numbers, ElementsAre(1));
  EXPECT_THAT(ParseControlRequest({"step", "20"}).numbers, ElementsAre(20));
  EXPECT_THAT(ParseControlRequest({"speed", "0.5"}).numbers, ElementsAre(0.5));
  const ControlRequest move = ParseControlRequest({"world", "move", "fb0", "1,2,0,0,0,90"});
  EXPECT_EQ(move.experiment, "world");
  EXPECT_EQ(move.entity, "fb0");
  EXPECT_THAT(move.numbers, ElementsAre(1, 2, 0, 0, 0, 90));
  // An entity may be called like a verb.
  EXPECT_EQ(ParseControlRequest({"move", "stop", "-1,2,0"}).entity, "stop");
  const ControlRequest add = ParseControlRequest({"add", "remove", "1,2,0"});
  EXPECT_EQ(add.verb, "add");
  EXPECT_EQ(add.entity, "remove");
  EXPECT_THAT(add.numbers, ElementsAre(1, 2, 0));
  const ControlRequest remove = ParseControlRequest({"world", "remove", "fb0"});
  EXPECT_EQ(remove.experiment, "world");
  EXPECT_EQ(remove.entity, "fb0");
  EXPECT_THAT(remove.numbers, ElementsAre());
}

TEST(ControlRequest, ReadsMovesOfWorkers)
{
  EXPECT_EQ(ParseControlRequest({"move-host", "1"}).entity, "1");
  EXPECT_EQ(ParseControlRequest({"world", "move-host", "1", "beta"}).entity, "1 to beta");
  EXPECT_EQ(ParseControlRequest({"move-engine", "ground", "beta"}).verb, "move-engine");
  EXPECT_EQ(ParseControlRequest({"drain", "alpha"}).entity, "alpha");
  EXPECT_THAT(ParseControlRequest({"hosts", "+2"}).numbers, ElementsAre(2));
  EXPECT_THAT(ParseControlRequest({"world", "hosts", "again"}).numbers, ElementsAre(0));
  EXPECT_THAT(ParseControlRequest({"world", "hosts", "-1", "beta"}).numbers, ElementsAre(-1));
  EXPECT_EQ(ParseControlRequest({"world", "hosts", "-1", "beta"}).entity, "beta");
}

TEST(ControlRequest, ReadsTheSeedOfAReset)
{
  EXPECT_EQ(ParseControlRequest({"reset"}).entity, "");
  EXPECT_EQ(ParseControlRequest({"world", "reset"}, 0).entity, "0");
  EXPECT_EQ(ParseControlRequest({"reset"}, 9007199254740993).entity, "9007199254740993");
  EXPECT_THROW(ParseControlRequest({"pause"}, 7), UsageError);
}

TEST(ControlRequest, ErrorsSayTheRightForm)
{
  EXPECT_THAT(ErrorOf({"reset", "7"}), HasSubstr("reset --seed N"));
  EXPECT_THAT(ErrorOf({"move-host"}), HasSubstr("write move-host N"));
  EXPECT_THAT(ErrorOf({"move-host", "ground"}), HasSubstr("is no number of a controller host"));
  EXPECT_THAT(ErrorOf({"drain", "alpha", "beta"}), HasSubstr("write drain MACHINE"));
  EXPECT_THAT(ErrorOf({"hosts"}), HasSubstr("write hosts +N or hosts -N"));
  EXPECT_THAT(ErrorOf({"hosts", "2"}), HasSubstr("write hosts +N or hosts -N"));
  EXPECT_THAT(ErrorOf({"hosts", "+0"}), HasSubstr("write hosts +N or hosts -N"));
  EXPECT_THAT(ErrorOf({"hosts", "again", "beta"}), HasSubstr("takes no machine, but 'beta' is there; write hosts +N"));
  EXPECT_THAT(ErrorOf({"paus"}), HasSubstr("did you mean 'pause'?"));
  EXPECT_THAT(ErrorOf({"spede", "2"}), HasSubstr("there is no 'spede'"));
  EXPECT_THAT(ErrorOf({"spede", "2"}), HasSubstr("did you mean 'speed'?"));
  EXPECT_THAT(ErrorOf({"diffusion_10", "spede", "2"}), HasSubstr("did you mean 'speed'?"));
  EXPECT_THAT(ErrorOf({"mvoe", "fb0", "1,2,0"}), HasSubstr("did you mean 'move'?"));
  EXPECT_THAT(ErrorOf({"step", "0"}), HasSubstr("step N"));
  EXPECT_THAT(ErrorOf({"step", "1.5"}), HasSubstr("step N"));
  EXPECT_THAT(ErrorOf({"speed"}), HasSubstr("speed F"));
  EXPECT_THAT(ErrorOf({"speed", "-1"}), HasSubstr("negative"));
  EXPECT_THAT(ErrorOf({"move", "fb0", "1,2"}), HasSubstr("X,Y,Z"));
  EXPECT_THAT(ErrorOf({"pause", "now"}), HasSubstr("'now'"));
  EXPECT_THAT(ErrorOf({"add", "fb0"}), HasSubstr("add ENTITY X,Y,Z"));
  EXPECT_THAT(ErrorOf({"remove"}), HasSubstr("remove ENTITY"));
  EXPECT_THAT(ErrorOf({"world", "remove", "fb0", "1,2,0"}), HasSubstr("remove ENTITY"));
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
