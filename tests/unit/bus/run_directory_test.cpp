#include "common/bus/run_directory.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// A folder of runs of its own, so that others' are not touched.
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

  std::string folder_;
};

TEST_F(RunDirectoryTest, IsFoundWhileItsServerLivesAndGoneAfterwards)
{
  std::string path;
  {
    RunDirectory directory("diffusion 10", 255);
    path = directory.Path();
    EXPECT_TRUE(FindLocalRuns().empty());
    directory.Announce("diffusion 10", 7);
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

TEST_F(RunDirectoryTest, WhatAKilledProcessLeftIsRemovedByTheNext)
{
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    RunDirectory directory("killed", 1);
    directory.Announce("killed", 3);
    if (write(ready[1], "r", 1) != 1) _exit(1);
    pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_EQ(FindLocalRuns().size(), 1U);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(FindLocalRuns().empty());
  EXPECT_TRUE(fs::exists(folder_ + "/killed-0000000000000001"));
  RemoveDeadRuns();
  EXPECT_FALSE(fs::exists(folder_ + "/killed-0000000000000001"));
}

}  // namespace
}  // namespace swarmanoid
