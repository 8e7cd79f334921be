// The supervisor against clusters of shell scripts that behave as the real programs do, and as broken ones do.
#include "launcher/processes/supervisor.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace swarmanoid
{
namespace
{

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

const char* const kFinishing = "echo state running; echo tick 5 5 2.5; echo finished 5 2 00000000000000ff 0.2 2.5";
const char* const kRunning = "echo state running; echo tick 7 100 2.5; exec sleep 20";
const char* const kStoppable =
    "trap 'echo finished 8 2 00000000000000aa 0.3 1.5; kill $!; exit 0' INT; echo state running; sleep 20 & wait";

void PressAfter(milliseconds time, int signal = SIGINT)
{
  std::this_thread::sleep_for(time);
  kill(getpid(), signal);
}

bool GroupRuns(pid_t group)
{
  for (const auto& entry : std::filesystem::directory_iterator("/proc"))
  {
    std::ifstream stat(entry.path() / "stat");
    std::string line;
    if (!std::getline(stat, line)) continue;
    std::istringstream fields(line.substr(line.rfind(')') + 1));
    std::string state, parent;
    pid_t of = 0;
    if (fields >> state >> parent >> of && of == group && state != "Z") return true;
  }
  return false;
}

// A killed process needs a moment.
bool GroupIsGone(pid_t group)
{
  for (int i = 0; i < 100 && GroupRuns(group); ++i) std::this_thread::sleep_for(milliseconds(5));
  return !GroupRuns(group);
}

class SupervisorTest : public testing::Test
{
protected:
  SupervisorTest()
  {
    folder_ = std::filesystem::temp_directory_path() / ("swarmanoid_supervisor_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    times_.refresh = milliseconds(20);
    times_.terminate = milliseconds(100);
    times_.settle = milliseconds(60);
    times_.early_end = milliseconds(200);
    times_.finish = milliseconds(300);
    times_.finish_visualiser = milliseconds(600);
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    screen_read_.Reset(ends[0]);
    screen_write_.Reset(ends[1]);
  }
  ~SupervisorTest() override { std::filesystem::remove_all(folder_); }

  void Add(const std::string& name, const std::string& script, MemberPlan::Output output = MemberPlan::kLog)
  {
    MemberPlan plan;
    plan.command.name = name;
    plan.command.arguments = {"/bin/sh", "-c", script};
    plan.log_path = folder_ / (name + ".log");
    plan.output = output;
    plan.visualiser = name == "visualiser";
    plans_.push_back(plan);
  }
  void AddServer(const std::string& script) { Add("space_server", script, MemberPlan::kStatus); }

  ClusterOutcome Run()
  {
    ProgressDisplay display(ProgressDisplay::Style::kQuiet, 2);
    Supervisor supervisor(spawner_, interrupts_, display, screen_write_.Get(), {}, times_);
    const Clock::time_point start = Clock::now();
    ClusterOutcome outcome = supervisor.Run(plans_);
    took_ = std::chrono::duration_cast<milliseconds>(Clock::now() - start);
    for (const pid_t pid : supervisor.Pids())
      EXPECT_TRUE(GroupIsGone(pid)) << "a process of group " << pid << " is left";
    return outcome;
  }

  std::string LogText(const std::string& name) const
  {
    std::ostringstream text;
    text << std::ifstream(folder_ / (name + ".log")).rdbuf();
    return text.str();
  }
  std::string ScreenText()
  {
    screen_write_.Reset();
    std::string text;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(screen_read_.Get(), buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(count));
    return text;
  }

  Interrupts interrupts_;  // first: threads of the tests must not get the signals
  std::filesystem::path folder_;
  SupervisorTimes times_;
  SystemSpawner spawner_;
  std::vector<MemberPlan> plans_;
  FileDescriptor screen_read_, screen_write_;
  milliseconds took_{};
};

TEST_F(SupervisorTest, ReportsTheServersLastWordWhenAllEndCleanly)
{
  AddServer(kFinishing);
  Add("engine_worker ground", "sleep 0.05");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  ASSERT_TRUE(outcome.finished);
  EXPECT_EQ(outcome.finished->ticks, 5U);
  EXPECT_EQ(outcome.finished->hash, 0xffU);
}

TEST_F(SupervisorTest, NamesTheKilledProcessItsTickAndItsLog)
{
  AddServer(kRunning);
  Add("engine_worker ground", "sleep 0.1; echo about to die >&2; kill -9 $$");
  Add("controller_host 0", "exec sleep 20");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_EQ(outcome.reason, "engine_worker ground was killed by signal 9 (Killed) at tick 7; its log is " +
                                (folder_ / "engine_worker ground.log").string());
  EXPECT_EQ(outcome.log_lines, std::vector<std::string>{"about to die"});
  EXPECT_LT(took_, milliseconds(1000));
}

TEST_F(SupervisorTest, StopsProcessesThatIgnoreSigterm)
{
  AddServer(kRunning);
  Add("engine_worker ground", "sleep 0.05; exit 1");
  Add("controller_host 0", "trap '' TERM; while true; do sleep 1; done");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
  EXPECT_LT(took_, milliseconds(1000));
}

TEST_F(SupervisorTest, StopsProcessesThatAreStopped)
{
  AddServer(kRunning);
  Add("engine_worker ground", "sleep 0.05; exit 1");
  Add("controller_host 0", "kill -STOP $$");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
  EXPECT_LT(took_, milliseconds(1000));
}

TEST_F(SupervisorTest, AServerThatEndsWithoutAResultFailed)
{
  AddServer("echo state running; echo error the arena is empty");
  Add("engine_worker ground", "exec sleep 20");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(
      outcome.reason.starts_with("space_server ended before the last tick at tick 0 (the arena is empty); its log is "))
      << outcome.reason;
}

TEST_F(SupervisorTest, AWorkerThatEndsEarlyFailed)
{
  AddServer(kRunning);
  Add("engine_worker ground", "exit 0");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground ended before the last tick at tick 7"))
      << outcome.reason;
}

TEST_F(SupervisorTest, WorkersMayEndBeforeTheLastPictureIsDrawn)
{
  AddServer("echo state running; sleep 0.5; echo finished 5 2 00000000000000ff 0.2 2.5");
  Add("engine_worker ground", "exit 0");
  Add("visualiser", "exec sleep 0.4");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, BlamesTheOneThatTheServerAccuses)
{
  AddServer("echo state running; sleep 0.1; echo \"error engine 'ground': division by zero\"; exit 4");
  Add("controller host 0", "sleep 0.1; exit 4");
  Add("engine 'ground'", "sleep 0.12; echo division by zero; exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with(
      "engine 'ground' ended with exit code 4 at tick 0 (engine 'ground': division by zero)"))
      << outcome.reason;
}

TEST_F(SupervisorTest, ThoseThatEndForAnotherAreNotItsHeadline)
{
  AddServer("echo state running; sleep 0.1; echo \"error controller host 0 failed\"; exit 6");
  Add("engine 'ground'", "sleep 0.05; exit 6");
  Add("controller host 0", "sleep 0.5; exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_TRUE(outcome.reason.starts_with("controller host 0 ended with exit code 4")) << outcome.reason;
}

TEST_F(SupervisorTest, IfNobodyFailedTheServerSaysWhy)
{
  times_.others = milliseconds(200);
  AddServer("echo state running; sleep 0.1; echo \"error engine 'far' does not answer any more\"; exit 6");
  Add("engine 'ground'", "sleep 0.05; exit 6");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine 'far' does not answer any more; the log of space_server is "))
      << outcome.reason;
}

TEST_F(SupervisorTest, AWorkerMayEndJustBeforeTheServersLastWord)
{
  AddServer(std::string("sleep 0.1;") + kFinishing);
  Add("engine_worker ground", "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AnInvalidExperimentIsToldApart)
{
  AddServer(kRunning);
  Add("engine_worker ground", "echo 'x.xml:3:4: no such thing' >&2; exit 3");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInvalid);
  EXPECT_EQ(outcome.log_lines, std::vector<std::string>{"x.xml:3:4: no such thing"});
}

TEST_F(SupervisorTest, AnExperimentMayFailByItsOwnMeasure)
{
  AddServer(std::string(kFinishing) + "; exit 1");
  Add("engine_worker ground", "sleep 0.1");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kUnsuccessful) << outcome.reason;
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, AKilledVisualiserSpoilsAFinishedRun)
{
  AddServer(kFinishing);
  Add("visualiser", "sleep 0.1; kill -9 $$", MemberPlan::kScreen);
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
}

TEST_F(SupervisorTest, WaitsLongerForVisualisersThanForWorkers)
{
  AddServer(kFinishing);
  Add("visualiser", "sleep 0.45", MemberPlan::kScreen);
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AWorkerThatNeverEndsFailed)
{
  AddServer(kFinishing);
  Add("engine_worker ground", "exec sleep 20");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground did not end within 300 ms of the last tick"))
      << outcome.reason;
}

TEST_F(SupervisorTest, OneInterruptStopsAtATickAndKeepsTheResult)
{
  AddServer(kStoppable);
  Add("engine_worker ground", "sleep 0.5");
  std::jthread press([] { PressAfter(milliseconds(250)); });
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  ASSERT_TRUE(outcome.finished);
  EXPECT_EQ(outcome.finished->ticks, 8U);
}

TEST_F(SupervisorTest, TwoInterruptsKill)
{
  AddServer("trap '' INT; echo state running; while true; do sleep 1; done");
  Add("controller_host 0", "trap '' TERM; while true; do sleep 1; done");
  std::jthread press(
      []
      {
        // Well apart: two signals that are pending at once are one.
        PressAfter(milliseconds(300));
        PressAfter(milliseconds(1200));
      });
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_FALSE(outcome.finished);
  EXPECT_LT(took_, milliseconds(2500));
}

TEST_F(SupervisorTest, SigtermEndsEvenAStuckRun)
{
  times_.forced_stop = milliseconds(200);
  AddServer("trap '' INT TERM; echo state running; while true; do sleep 1; done");
  std::jthread press([] { PressAfter(milliseconds(150), SIGTERM); });
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
  EXPECT_LT(took_, milliseconds(1500));
}

TEST_F(SupervisorTest, ShowsWhatVisualisersWriteToTheScreen)
{
  AddServer(std::string("echo a line for the log; sleep 0.2;") + kFinishing);
  // It ends after the server, as visualisers do; one that ends before is a failure.
  Add("visualiser", "echo one; echo two; echo aside >&2; sleep 0.5", MemberPlan::kScreen);
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_EQ(ScreenText(), "one\ntwo\n");
  EXPECT_EQ(LogText("visualiser"), "aside\n");
  EXPECT_EQ(LogText("space_server"), "a line for the log\n");
}

TEST_F(SupervisorTest, AFullScreenDoesNotDeafenIt)
{
  AddServer(kStoppable);
  Add("visualiser", "trap 'exit 0' TERM; yes", MemberPlan::kScreen);
  std::jthread press(
      []
      {
        for (int i = 0; i < 2; ++i) PressAfter(milliseconds(200));
      });
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
  EXPECT_LT(took_, milliseconds(2000));
}

TEST_F(SupervisorTest, StopsWhenNobodyReadsTheScreen)
{
  AddServer(kStoppable);
  Add("visualiser", "sleep 0.2; for i in 1 2 3; do echo line; sleep 0.05; done", MemberPlan::kScreen);
  screen_read_.Reset();
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, AMissingProgramIsNamedAndNothingIsLeft)
{
  AddServer(kRunning);
  Add("engine_worker ground", "");
  plans_.back().command.arguments = {"/nowhere/engine_worker"};
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_EQ(outcome.reason, "cannot start engine_worker ground: '/nowhere/engine_worker': No such file or directory");
}

TEST(SystemSpawner, TheKernelKillsTheProcessesOfAKilledLauncher)
{
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t launcher = fork();
  if (launcher == 0)
  {
    SystemSpawner spawner;
    const SpawnedProcess process = spawner.Start({"sleeper", {"sleep", "20"}, {}, {}});
    [[maybe_unused]] const ssize_t written = write(ends[1], &process.pid, sizeof process.pid);
    raise(SIGKILL);
  }
  pid_t child = 0;
  ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
  waitpid(launcher, nullptr, 0);
  for (int i = 0; i < 100; ++i)
  {
    std::ifstream status("/proc/" + std::to_string(child) + "/stat");
    std::string pid, name, state;
    if (!(status >> pid >> name >> state) || state == "Z") return;
    std::this_thread::sleep_for(milliseconds(10));
  }
  FAIL() << "process " << child << " outlives its launcher";
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
