// Files that an experiment names stay below a folder and replace nothing of others.
#include "common/configuration/output_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputFileTest : public testing::Test
{
protected:
  OutputFileTest()
  {
    fs::create_directory(folder_ / "run");
    folder_.Write("precious", "kept");
  }

  OutputFiles OfExperiment() const { return OutputFiles((folder_ / "run").string()); }
  static std::string ErrorOf(const std::function<void()>& call)
  {
    return test::MessageOf<OutputFileError>(call, "no error");
  }
  void ExpectRefused(const std::string& name, const std::string& why) const
  {
    EXPECT_THAT(ErrorOf([&] { OfExperiment().Check(name); }), testing::AllOf(HasSubstr(why), HasSubstr("--trust")));
    EXPECT_THAT(ErrorOf([&] { OfExperiment().Claim(name); }), HasSubstr(why)) << name;
  }
  std::string Read(const std::string& name) const { return folder_.Read(name); }

  const test::TemporaryFolder folder_;
};

TEST_F(OutputFileTest, NamesBelowTheFolderAreMadeWithTheirFolders)
{
  for (const std::string name : {"table.txt", "a/b/table.txt", "./c.txt", "a//d.txt"})
  {
    OfExperiment().Check(name);
    const std::string path = OfExperiment().Claim(name);
    EXPECT_TRUE(fs::is_regular_file(path)) << path;
    EXPECT_TRUE(fs::equivalent(path, folder_ / "run" / name));
  }
}

TEST_F(OutputFileTest, TheFolderItselfIsMadeIfItIsNotThere)
{
  const OutputFiles files((folder_ / "results/first").string());
  files.Check("a/table.txt");
  EXPECT_TRUE(fs::is_regular_file(files.Claim("a/table.txt")));
}

TEST_F(OutputFileTest, NamesThatLeaveTheFolderAreRefused)
{
  const std::string absolute = (folder_ / "precious").string();
  for (const std::string& name :
       {absolute, std::string("../precious"), std::string("a/../../precious"), std::string(".."), std::string(),
        std::string("."), std::string("a/"), std::string("a\0b", 3)})
    ExpectRefused(name, "is no file below the folder of the run");
  EXPECT_EQ(Read("precious"), "kept");
}

TEST_F(OutputFileTest, LinksAreNotFollowed)
{
  fs::create_symlink(folder_ / "precious", folder_ / "run/link.txt");
  fs::create_symlink(folder_ / "nowhere", folder_ / "run/dangling.txt");
  fs::create_directory_symlink(folder_, folder_ / "run/folder");
  ExpectRefused("link.txt", "is a link");
  ExpectRefused("dangling.txt", "is a link");
  ExpectRefused("folder/new.txt", "is a link");
  EXPECT_FALSE(fs::exists(folder_ / "new.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(OutputFileTest, AFileThatTheRunDidNotMakeIsNotReplaced)
{
  std::ofstream(folder_ / "run/older.txt") << "kept";
  ExpectRefused("older.txt", "was not made by this run");
  EXPECT_EQ(Read("run/older.txt"), "kept");
  fs::remove(folder_ / "run/older.txt");
  OfExperiment().Claim("older.txt");
  // The process that made it may write it again.
  OfExperiment().Check("older.txt");
  OfExperiment().Claim("older.txt");
  fs::create_directory(folder_ / "run/folder");
  ExpectRefused("folder", "is no file");
}

TEST_F(OutputFileTest, TheFilesInTheFolderOfARunAreOfThatRun)
{
  std::ofstream(folder_ / "run/manifest.json") << "{}";
  std::ofstream(folder_ / "run/table.txt") << "of a process that died";
  OfExperiment().Claim("table.txt");
  // The link is another name of a file elsewhere.
  fs::create_hard_link(folder_ / "precious", folder_ / "run/second.txt");
  ExpectRefused("second.txt", "was not made by this run");
}

TEST_F(OutputFileTest, FilesOfARunAreNotWrittenThroughLinks)
{
  fs::create_symlink(folder_ / "precious", folder_ / "run/log");
  EXPECT_EQ(OpenOutputFile((folder_ / "run/log").string()), nullptr);
  EXPECT_EQ(OpenOutputFile((folder_ / "run/log").string(), true), nullptr);
  EXPECT_EQ(Read("precious"), "kept");
}

TEST_F(OutputFileTest, AFolderThatOthersCanWriteOrOwnIsNoFolderForARun)
{
  const std::string run = (folder_ / "run").string();
  EXPECT_EQ(OutputFolderMistake(run), "");
  EXPECT_EQ(OutputFolderMistake(run + "/none"), "");
  ASSERT_EQ(chmod(run.c_str(), 0777), 0);
  EXPECT_THAT(OutputFolderMistake(run), HasSubstr("all users can write there"));
  // The sticky bit keeps users from removing files of other users.
  ASSERT_EQ(chmod(run.c_str(), 01777), 0);
  EXPECT_EQ(OutputFolderMistake(run), "");
  // Root has to give a folder away; others have some that are root's.
  const std::string of_another = geteuid() == 0 ? run : "/etc";
  if (geteuid() == 0)
  {
    ASSERT_EQ(chown(run.c_str(), 65534, 65534), 0);
  }
  EXPECT_THAT(OutputFolderMistake(of_another), HasSubstr("it belongs to another user"));
}

TEST(OutputFiles, TheUserMayNameAnyFile)
{
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "run");
  folder.Write("precious", "replaced");
  // The test runs in a child process, so that this process does not change.
  EXPECT_EXIT(
      {
        LetUserNameFiles();
        const OutputFiles files((folder / "run").string());
        files.Check("../precious");
        const bool same = files.Claim((folder / "precious").string()) == (folder / "precious").string();
        files.Claim("new/table.txt");
        std::exit(same && fs::is_directory(folder / "run/new") ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace swarmanoid
