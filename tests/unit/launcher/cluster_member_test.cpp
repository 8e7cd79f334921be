// A process of a cluster and what starts it: its output, its environment, and that it leaves nothing behind.
#include "launcher/supervision/cluster_member.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>

#include "tests/unit/launcher/process_groups.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;

TEST(SystemSpawner, TheKernelKillsTheProcessesOfAKilledLauncher)
{
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t launcher = fork();
  if (launcher == 0)
  {
    SystemSpawner spawner;
    const SpawnedProcess process = spawner.Start({"sleeper", {"sleep", "600"}, {}, {}});
    [[maybe_unused]] const ssize_t written = write(ends[1], &process.pid, sizeof process.pid);
    raise(SIGKILL);
  }
  pid_t child = 0;
  ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
  waitpid(launcher, nullptr, 0);
  const auto is_gone = [=]
  {
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    std::string pid, name, state;
    return !(status >> pid >> name >> state) || state == "Z";
  };
  EXPECT_TRUE(Eventually(is_gone)) << "process " << child << " outlives its launcher";
}

TEST(SystemSpawner, WhatAProcessStartedItselfEndsWithIt)
{
  SystemSpawner spawner;
  const SpawnedProcess process = spawner.Start({"shell", {"sh", "-c", "sleep 600 & sleep 600 &"}, {}, {}});
  EXPECT_TRUE(spawner.Collect(process).Clean());
  EXPECT_TRUE(GroupIsGone(process.pid));
}

class ClusterMemberTest : public testing::Test
{
protected:
  PlannedProcess Visualiser() const
  {
    return {.name = "visualiser", .role = ProcessRole::kVisualiser, .log_path = folder_ / "visualiser.log"};
  }
  static ProcessCommand Script(const std::string& script)
  {
    return {.name = "visualiser", .arguments = {"/bin/sh", "-c", script}};
  }
  std::string LogText() const { return test::TextOf(folder_ / "visualiser.log"); }

  const test::TemporaryFolder folder_;
  SystemSpawner spawner;
};

TEST_F(ClusterMemberTest, TheLastWordsOfAProcessAreInItsLog)
{
  {
    ClusterMember member(Visualiser(), Script("echo one >&2; printf two >&2; exit 3"), spawner);
    member.Collect(spawner);
    EXPECT_EQ(member.End()->exit_code, 3);
  }
  EXPECT_EQ(LogText(), "one\ntwo\n");
}

// A process by ssh believes that it writes to a terminal.
TEST_F(ClusterMemberTest, ColoursOfATerminalDoNotReachTheLog)
{
  {
    ClusterMember member(
        Visualiser(),
        Script("printf '\\033[31mred\\033[0m and \\033]0;title\\n\\033[1;33mwarning:\\033[m done\\033' >&2"), spawner);
    member.Collect(spawner);
  }
  EXPECT_EQ(LogText(), "red and 0;title\nwarning: done\n");
}

// A process of a user's code may leave a child behind, in a session of its own, that keeps the output open.
TEST_F(ClusterMemberTest, OutputEndsWithItsProcessWhoeverElseHoldsItOpen)
{
  ClusterMember member(Visualiser(), Script("setsid sh -c 'echo $$; exec sleep 600' & exec sleep 600"), spawner);
  std::vector<std::string> lines;
  const auto read_output = [&]
  { member.ReadOutput([&](std::string_view line) { lines.emplace_back(line); }, 100'000); };
  ASSERT_TRUE(Eventually(
      [&]
      {
        read_output();
        return !lines.empty();
      }));
  const pid_t left_behind = std::stoi(lines.front());
  spawner.Signal(member.Process(), SIGKILL);
  member.Collect(spawner);
  EXPECT_FALSE(member.OutputClosed());
  read_output();
  EXPECT_EQ(kill(left_behind, 0), 0) << "no process held the output open";
  EXPECT_TRUE(member.OutputClosed());
  kill(left_behind, SIGKILL);
}

TEST(SystemSpawner, GivesEnvironmentAndCores)
{
  SystemSpawner spawner;
  const int core = AvailableCores().back();
  const SpawnedProcess process = spawner.Start(
      {"shell", {"sh", "-c", "echo $COLOUR; taskset -cp $$ | sed 's/.*: //'"}, {{"COLOUR", "red"}}, {core}});
  EXPECT_TRUE(spawner.Collect(process).Clean());
  char buffer[256];
  const ssize_t count = read(process.output.Get(), buffer, sizeof buffer);
  EXPECT_EQ(std::string(buffer, static_cast<std::size_t>(count)), "red\n" + std::to_string(core) + "\n");
}

}  // namespace
}  // namespace swarmanoid
