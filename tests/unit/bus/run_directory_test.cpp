#include "common/run/access/run_directory.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/bus.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// Has its own folder of runs, so that other runs are not touched.
class RunDirectoryTest : public testing::Test
{
protected:
  RunDirectoryTest() : folder_("/dev/shm/swarmanoid-test-" + std::to_string(getpid()))
  {
    setenv("SWARMANOID_SHARED_FOLDER", folder_.c_str(), 1);
  }
  ~RunDirectoryTest() override
  {
    fs::remove_all(folder_);
    unsetenv("SWARMANOID_SHARED_FOLDER");
  }

  // The folder of a run whose only process, its server, was killed.
  std::string KilledRun() const
  {
    int ready[2];
    EXPECT_EQ(pipe(ready), 0);
    const pid_t child = fork();
    if (child == 0)
    {
      RunDirectory directory("killed", 1);
      directory.Announce("killed", 3, std::nullopt);
      if (write(ready[1], "r", 1) != 1) _exit(1);
      pause();
      _exit(0);
    }
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    EXPECT_EQ(FindLocalRuns().size(), 1U);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_TRUE(FindLocalRuns().empty());
    close(ready[0]);
    close(ready[1]);
    const std::string left = folder_ + "/killed-0000000000000001";
    EXPECT_TRUE(fs::exists(left));
    return left;
  }

  std::string folder_;
};

TEST_F(RunDirectoryTest, IsFoundWhileItsServerLivesAndGoneAfterwards)
{
  std::string path;
  {
    RunDirectory directory("diffusion 10", 255);
    path = directory.Path();
    EXPECT_TRUE(FindLocalRuns().empty());
    directory.Announce("diffusion 10", 7, std::nullopt);
    const auto runs = FindLocalRuns();
    ASSERT_EQ(runs.size(), 1U);
    EXPECT_EQ(runs[0].experiment, "diffusion 10");
    EXPECT_EQ(runs[0].domain, 7);
    EXPECT_EQ(runs[0].server, getpid());
    RemoveDeadRuns();
    EXPECT_TRUE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(RunDirectoryTest, ARunIsFoundWithItsNetwork)
{
  RunDirectory directory("far", 255);
  const RunNetwork network{"eth0", {"alpha", "10.0.0.7"}, "10.0.0.1:21900"};
  directory.Announce("far", 7, std::nullopt, network);
  ASSERT_EQ(FindLocalRuns().size(), 1U);
  EXPECT_EQ(FindLocalRuns()[0].network, network);
  directory.Announce("far", 7, std::nullopt);
  EXPECT_EQ(FindLocalRuns()[0].network, RunNetwork{});
}

TEST_F(RunDirectoryTest, AnotherReleaseOfFastDdsMayNotShareItsMemory)
{
  RunDirectory directory("mixed", 255);
  RequireSameRelease(directory.Path(), "2.9");
  RequireSameRelease(directory.Path(), "2.9");
  EXPECT_THAT(test::MessageOf<BusError>([&] { RequireSameRelease(directory.Path(), "3.1"); }),
              testing::HasSubstr("this program uses Fast DDS 3.1, and the run on this machine Fast DDS 2.9"));
}

TEST_F(RunDirectoryTest, WhatAKilledProcessLeftIsRemovedWhenAsked)
{
  const std::string left = KilledRun();
  RemoveDeadRuns();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_FALSE(fs::exists(folder_));
}

// On a machine where only workers run, by ssh, no launcher and no server ever removes dead runs.
TEST_F(RunDirectoryTest, WhatAKilledProcessLeftIsRemovedByTheNextOfAnyRun)
{
  const std::string left = KilledRun();
  const RunDirectory worker("another", 2);
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(worker.Path()));
}

TEST_F(RunDirectoryTest, WhoJoinsLeavesLiveRunsAlone)
{
  RunDirectory server("first", 1);
  server.Announce("first", 3, std::nullopt);
  const RunDirectory worker("another", 2);
  EXPECT_EQ(FindLocalRuns().size(), 1U);
  EXPECT_TRUE(fs::exists(server.Path() + "/server"));
}

TEST_F(RunDirectoryTest, WhatIsNotOursStaysWhereItIs)
{
  fs::create_directories(folder_ + "/thesis/chapters");
  std::ofstream(folder_ + "/thesis/chapters/one.tex") << "text";
  std::ofstream(folder_ + "/thesis/process.1") << "";
  std::ofstream(folder_ + "/thesis/server") << "7 1\nthesis\n";
  fs::create_directories(folder_ + "/empty");
  RemoveDeadRuns();
  {
    RunDirectory directory("ours", 1);
    directory.Announce("ours", 7, std::nullopt);
    EXPECT_EQ(FindLocalRuns().size(), 1U);
  }
  RemoveDeadRuns();
  EXPECT_FALSE(fs::exists(folder_ + "/ours-0000000000000001"));
  EXPECT_TRUE(fs::exists(folder_ + "/thesis/chapters/one.tex"));
  EXPECT_TRUE(fs::exists(folder_ + "/thesis/process.1"));
  EXPECT_TRUE(fs::exists(folder_ + "/empty"));
}

TEST_F(RunDirectoryTest, AFolderOfOthersIsNotTakenForARun)
{
  fs::create_directories(folder_ + "/ours-0000000000000001");
  std::ofstream(folder_ + "/ours-0000000000000001/letter") << "text";
  EXPECT_THROW(RunDirectory("ours", 1), BusError);
  EXPECT_TRUE(fs::exists(folder_ + "/ours-0000000000000001/letter"));
}

TEST_F(RunDirectoryTest, LinksAreNotFollowed)
{
  const std::string victim = folder_ + ".victim";
  fs::create_directories(victim);
  {
    // The content of the folder looks like a run that died.
    setenv("SWARMANOID_SHARED_FOLDER", victim.c_str(), 1);
    RunDirectory directory("dead", 1);
    fs::create_directories(victim + "/kept-1");
    fs::copy(directory.Path() + "/.swarmanoid-run", victim + "/kept-1/.swarmanoid-run");
    std::ofstream(victim + "/kept-1/letter") << "text";
    setenv("SWARMANOID_SHARED_FOLDER", folder_.c_str(), 1);
    fs::create_symlink(victim, folder_);
    RemoveDeadRuns();
    EXPECT_TRUE(FindLocalRuns().empty());
    EXPECT_THROW(RunDirectory("other", 2), BusError);
    setenv("SWARMANOID_SHARED_FOLDER", (folder_ + "/").c_str(), 1);
    RemoveDeadRuns();
    EXPECT_THROW(RunDirectory("other", 2), BusError);
    EXPECT_TRUE(fs::exists(victim + "/kept-1/letter"));

    // It is a link within the folder.
    fs::remove(folder_);
    fs::create_directory(folder_);
    fs::create_symlink(victim + "/kept-1", folder_ + "/dead-2");
    RemoveDeadRuns();
    EXPECT_TRUE(fs::exists(victim + "/kept-1/letter"));
    EXPECT_TRUE(fs::is_symlink(folder_ + "/dead-2"));
    setenv("SWARMANOID_SHARED_FOLDER", victim.c_str(), 1);
  }
  fs::remove_all(victim);
}

TEST_F(RunDirectoryTest, OnlyThisUserMayWriteThere)
{
  {
    const RunDirectory directory("ours", 1);
    EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
    EXPECT_EQ(fs::status(directory.Path()).permissions(), fs::perms::owner_all);
  }
  fs::create_directory(folder_);
  fs::permissions(folder_, fs::perms::all);
  EXPECT_EQ(
      test::MessageOf<BusError>([&] { RunDirectory directory("ours", 1); }),
      "'" + folder_ + "' can be written by other users; remove it, or name another folder by SWARMANOID_SHARED_FOLDER");
}

}  // namespace
}  // namespace swarmanoid
