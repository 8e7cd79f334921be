// Tests the suggestions of shells after `swarmanoid`.
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "common/run/run_options.h"
#include "launcher/command/completion.h"
#include "launcher/command/sub_command.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Not;
using testing::StartsWith;

const std::string kSample = SWARMANOID_SOURCE_FOLDER "/configs/diffusion_10.xml";

class Completion : public testing::Test
{
protected:
  Completion() { AddSubCommands(app_, exit_code_); }

  std::vector<std::string> Offered(const std::vector<std::string>& words) const { return Completions(app_, words); }

private:
  int exit_code_ = 0;
  CLI::App app_{"", "swarmanoid"};
};

TEST_F(Completion, OffersCommandsThatBeginSo)
{
  EXPECT_THAT(Offered({"co"}), ElementsAre(StartsWith("control\t"), StartsWith("convert\t")));
  EXPECT_THAT(Offered({""}), Contains(StartsWith("run\t")));
  EXPECT_THAT(Offered({"new", "behavior-"}), ElementsAre(StartsWith("behavior-controller\t")));
}

TEST_F(Completion, OffersEachOptionOfTheTable)
{
  RunSettings settings;
  const auto offered = Offered({"run", kSample, "--"});
  for (const OptionSpec& option : RunOptionTable(settings))
  {
    if (option.value.name == "EXPERIMENT") continue;
    EXPECT_THAT(offered, Contains(StartsWith("--" + option.value.name + "\t")));
  }
}

TEST_F(Completion, OffersValuesOfTheirTypes)
{
  EXPECT_THAT(Offered({"run", kSample, "--placement", "o"}), ElementsAre("one-core"));
  EXPECT_THAT(Offered({"run", kSample, "--restore", ""}), ElementsAre(":files"));
  EXPECT_THAT(Offered({"run", ""}), ElementsAre(":files .xml"));
  for (const char* command : {"convert", "install", "pack"})
    EXPECT_THAT(Offered({command, ""}), ElementsAre(":files")) << command;
  // A flag takes no value: the next word is the experiment.
  EXPECT_THAT(Offered({"run", "--quiet", ""}), ElementsAre(":files .xml"));
  EXPECT_THAT(Offered({"run", "--seed", ""}), testing::IsEmpty());
}

TEST_F(Completion, OffersWhatMayBeSetInTheExperiment)
{
  EXPECT_THAT(Offered({"run", kSample, "--set", "framework.se"}), ElementsAre(StartsWith("framework.seed=\t")));
  EXPECT_THAT(Offered({"run", kSample, "--set", "controllers."}),
              AllOf(Not(testing::IsEmpty()), Each(StartsWith("controllers.diffusion."))));
}

TEST_F(Completion, OffersPlugInsAndRequests)
{
  EXPECT_THAT(Offered({"attach", "te"}), ElementsAre("text"));
  EXPECT_THAT(Offered({"list", "pa"}), ElementsAre(StartsWith("packages\t")));
  EXPECT_THAT(Offered({"list", "plugins", "footbot_wh"}), ElementsAre("footbot_wheels"));
  EXPECT_THAT(Offered({"control", "st"}),
              ElementsAre(StartsWith("step\tgo on for one tick or N"), StartsWith("stop\tend the run")));
}

}  // namespace
}  // namespace swarmanoid
