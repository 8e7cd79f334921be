#include "simulation/run_folder.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/activity/activity.h"
#include "common/activity/failure_report.h"
#include "launcher/supervision/manifest_at_death.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunFolderTest : public testing::Test
{
protected:
  RunFolderTest() { fs::current_path(folder_); }
  ~RunFolderTest() override { fs::current_path(before_); }
  std::string ErrorOf(const std::string& asked)
  {
    return test::MessageOf<RunFolderError>([&] { RunFolder(asked, "world"); });
  }

  fs::path before_ = fs::current_path();
  test::TemporaryFolder folder_;
};

TEST_F(RunFolderTest, AFolderThatOthersCanWriteIsRefused)
{
  fs::create_directory("open");
  fs::permissions("open", fs::perms::all);
  EXPECT_THAT(ErrorOf("open"), testing::AllOf(HasSubstr("all users can write there"), HasSubstr("--output")));
  fs::create_directory("runs");
  fs::permissions("runs", fs::perms::all);
  EXPECT_THAT(ErrorOf(""), HasSubstr("all users can write there"));
}

TEST_F(RunFolderTest, WritesNothingThroughALink)
{
  const RunFolder run("new", "world");
  fs::create_symlink(folder_ / "precious", run.File("manifest.json.new"));
  EXPECT_THROW(run.Write("manifest.json", "{}"), RunFolderError);
  EXPECT_FALSE(fs::exists(folder_ / "precious"));
}

TEST_F(RunFolderTest, RunsOfTheSameSecondGetFoldersOfTheirOwn)
{
  const RunFolder first("", "world");
  const RunFolder second("", "world");
  EXPECT_NE(first.Path(), second.Path());
  EXPECT_THAT(first.Path(), testing::StartsWith((folder_ / "runs" / "world-").string()));
  EXPECT_TRUE(fs::is_directory(second.Path()));
}

TEST_F(RunFolderTest, NeverWritesOverAnOldRun)
{
  EXPECT_EQ(RunFolder("mine", "world").Path(), (folder_ / "mine").string());
  EXPECT_EQ(ErrorOf("mine"), "") << "an empty folder is as good as a new one";
  std::ofstream("mine/precious.txt") << "data";
  EXPECT_THAT(ErrorOf("mine"), testing::AllOf(HasSubstr("'mine'"), HasSubstr("not empty"), HasSubstr("--output")));
  EXPECT_THAT(ErrorOf("mine/precious.txt"), HasSubstr("precious.txt"));
}

TEST_F(RunFolderTest, AFailedWriteKeepsTheOldFile)
{
  const RunFolder folder("mine", "world");
  folder.Write("manifest.json", "one");
  fs::create_directory("mine/manifest.json.new");
  EXPECT_THROW(folder.Write("manifest.json", "two"), RunFolderError);
  EXPECT_EQ(test::TextOf("mine/manifest.json"), "one");
}

TEST(Manifest, HoldsWhatIsKnown)
{
  Manifest manifest;
  manifest.experiment = "w\"o\xffrld";
  manifest.seed = 7;
  manifest.state_hash = 0xff;
  const std::string text = manifest.Text();
  EXPECT_THAT(text, HasSubstr("\"seed\": 7"));
  EXPECT_THAT(text, HasSubstr("\"state_hash\": \"00000000000000ff\""));
  EXPECT_THAT(text, testing::Not(HasSubstr("exit_code")));
}

// By a signal handler, which has no JSON library.
TEST_F(RunFolderTest, AProcessThatDiesCompletesItsManifest)
{
  const RunFolder folder("mine", "world");
  Manifest manifest;
  manifest.experiment = "world";
  manifest.started = TimeStamp();
  folder.Write("manifest.json", manifest.Text());
  const pid_t child = fork();
  if (child == 0)
  {
    const ManifestAtDeath at_death(folder, manifest);
    ReportDeaths("unit_test");
    OwnActivityPage().tick = 17;
    DieOf("said \"no\" \\ \x01 \xff \xed\xa0\x80 \xc3\xbc");
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 4);
  const auto json = nlohmann::json::parse(test::TextOf(folder.File("manifest.json")));
  EXPECT_EQ(json["experiment"], "world");
  EXPECT_EQ(json["exit_code"], 4);
  EXPECT_EQ(json["failure"], "unit_test said \"no\" \\   ? ??? \xc3\xbc at tick 17");
  EXPECT_GE(json["ended"], manifest.started);
  EXPECT_EQ(json["ended"].get<std::string>().size(), manifest.started.size());
  EXPECT_FALSE(fs::exists(folder.File("manifest.json.last")));
}

}  // namespace
}  // namespace swarmanoid
