// The supervisor against clusters of shell scripts that behave as the real programs do, and as broken ones do.
#include "launcher/processes/supervisor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "common/activity/exit_codes.h"
#include "tests/eventually.h"

namespace swarmanoid
{
namespace
{

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using test::Eventually;
using test::kGenerous;

const char* const kFinishing = "echo state running; echo tick 5 5 2.5; echo finished 5 2 00000000000000ff 0.2 2.5";

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
  return Eventually([=] { return !GroupRuns(group); });
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
    // If all processes end by themselves, nothing waits for these.
    times_.settle = times_.others = times_.early_end = kGenerous;
    times_.finish = times_.finish_visualiser = times_.forced_stop = kGenerous;
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
  void AddServer(const std::string& script)
  {
    Add("space_server", "echo $$ > " + Mark("server") + "; " + script, MemberPlan::kStatus);
  }

  // What takes the place of the process that was added last; `script` may use $1, which is its incarnation.
  void ReplaceBy(const std::string& script)
  {
    plans_.back().replacement = [script](unsigned incarnation, double, const std::vector<ControllerDeath>&) {
      return ProcessCommand{"", {"/bin/sh", "-c", script, "sh", std::to_string(incarnation)}, {}, {}};
    };
  }

  // Scripts, and the test itself, tell one another how far they are by files.
  std::string Mark(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  std::string Tell(const std::string& name) const { return "touch " + Mark(name) + "; "; }
  std::string Await(const std::string& name) const { return "until [ -e " + Mark(name) + " ]; do sleep 0.01; done; "; }
  // Until the supervisor has seen that the server has ended.
  std::string AwaitEndOfServer() const
  {
    return "while kill -0 $(cat " + Mark("server") + ") 2>/dev/null; do sleep 0.01; done; ";
  }
  bool IsTold(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  // An hour passes for the supervisor, which has looked at all that it watches before the script goes on.
  std::string LetAnHourPass() const { return Tell("an hour later") + Await("looked"); }
  Clock::time_point Now()
  {
    if (!IsTold("an hour later")) return Clock::now();
    if (++looks_ == 20) std::ofstream(folder_ / "looked");
    return Clock::now() + std::chrono::hours(1);
  }

  std::string Running() const
  {
    return "echo state running; echo tick 7 100 2.5; " + Tell("running") + "exec sleep 600";
  }
  // Ends at its tick once it is asked to.
  std::string Stoppable() const
  {
    return "trap 'echo finished 8 2 00000000000000aa 0.3 1.5; kill $!; exit 0' INT; echo state running; sleep 600 & " +
           Tell("running") + "wait";
  }
  // Sends signals to the test itself, each as soon as a script has told that name.
  std::jthread PressAt(std::vector<std::pair<std::string, int>> presses) const
  {
    return std::jthread(
        [this, presses = std::move(presses)]
        {
          for (const auto& [name, signal] : presses)
          {
            EXPECT_TRUE(Eventually([&] { return IsTold(name); })) << name;
            kill(getpid(), signal);
          }
        });
  }

  ClusterOutcome Run()
  {
    ProgressDisplay display(ProgressDisplay::Style::kQuiet, 2);
    Supervisor supervisor(
        spawner_, interrupts_, display, screen_write_.Get(), {}, times_, [this] { return Now(); }, retries_);
    const Clock::time_point start = Clock::now();
    ClusterOutcome outcome = supervisor.Run(plans_);
    EXPECT_LT(Clock::now() - start, kGenerous) << "it waited for a process that never ends";
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
  unsigned retries_ = 0;
  int looks_ = 0;  // at the clock, since an hour passed
  SystemSpawner spawner_;
  std::vector<MemberPlan> plans_;
  FileDescriptor screen_read_, screen_write_;
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
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "echo about to die >&2; kill -9 $$");
  Add("controller_host 0", "exec sleep 600");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_EQ(outcome.reason, "engine_worker ground was killed by signal 9 (Killed) at tick 7; its log is " +
                                (folder_ / "engine_worker ground.log").string());
  EXPECT_EQ(outcome.log_lines, std::vector<std::string>{"about to die"});
}

TEST_F(SupervisorTest, AnotherProcessTakesThePlaceOfOneThatWasKilled)
{
  retries_ = 1;
  AddServer("echo state running; echo tick 7 100 2.5; " + Tell("running") + Await("second") + kFinishing);
  Add("engine_worker ground", Await("running") + "echo the first; kill -9 $$");
  ReplaceBy("echo incarnation $1; " + Tell("second"));
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_EQ(LogText("engine_worker ground"), "the first\nincarnation 1\n");
}

TEST_F(SupervisorTest, OneThatDiesAgainAndAgainWithoutATickBetweenEndsTheRun)
{
  retries_ = 3;
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "sleep 0.1; kill -9 $$");
  ReplaceBy("echo incarnation $1; kill -9 $$");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground was killed by signal 9 (Killed) at tick 7; its log is "))
      << outcome.reason;
  EXPECT_EQ(LogText("engine_worker ground"), "incarnation 1\nincarnation 2\nincarnation 3\n");
}

TEST_F(SupervisorTest, AllStartAgainIfTheServerWasKilled)
{
  retries_ = 1;
  AddServer("echo state running; echo tick 7 100 2.5; " + Await("running") + "kill -9 $$");
  ReplaceBy("echo incarnation $1 >&2; " + std::string(kFinishing));
  Add("engine_worker ground", "echo the first; " + Tell("running") + "exec sleep 600");
  ReplaceBy("echo incarnation $1");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_EQ(outcome.finished->hash, 0xffU);
  EXPECT_EQ(LogText("space_server"), "incarnation 1\n");
  EXPECT_EQ(LogText("engine_worker ground"), "the first\nincarnation 1\n");
}

TEST_F(SupervisorTest, AllStartAgainIfTheServerWasKilledOnItsWayOut)
{
  retries_ = 1;
  AddServer(std::string(kFinishing) + "; kill -9 $$");
  ReplaceBy(std::string(kFinishing) + "; exit 1");
  Add("engine_worker ground", "exit 0");
  ReplaceBy("exit 0");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kUnsuccessful) << outcome.reason;
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, AllStartAgainIfOneIsStuckWithWhatADeadOneHeld)
{
  retries_ = 1;
  AddServer("echo state running; echo error held by the dead; exit 7");
  ReplaceBy(kFinishing);
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy("exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AllStartAgainIfTheServerIsStopped)
{
  retries_ = 1;
  times_.stopped = milliseconds(60);
  AddServer("echo state running; kill -STOP $$; " + Tell("came back"));
  ReplaceBy(kFinishing);
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy("exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_FALSE(IsTold("came back"));
}

// Ticks that were done already come again: they are no progress.
TEST_F(SupervisorTest, AServerThatDiesAgainAndAgainEndsTheRun)
{
  retries_ = 2;
  AddServer("echo state running; echo tick 7 100 2.5; sleep 0.1; kill -9 $$");
  ReplaceBy(
      "echo incarnation $1 >&2; echo state running; echo tick 3 100 2.5; echo tick 7 100 2.5; sleep 0.1; kill -9 $$");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("space_server was killed by signal 9 (Killed) at tick 7; its log is "))
      << outcome.reason;
  EXPECT_EQ(LogText("space_server"), "incarnation 1\nincarnation 2\n");
}

TEST_F(SupervisorTest, ControlCWhileAllStartAgainEndsTheRun)
{
  retries_ = 1;
  AddServer("echo state running; " + Tell("running") + "sleep 0.1; kill -9 $$");
  ReplaceBy(Tell("again") + "exec sleep 600");
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy("exec sleep 600");
  const std::jthread presses = PressAt({{"again", SIGINT}, {"again", SIGINT}});
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
}

TEST_F(SupervisorTest, OneThatIsLostIsKilledAndReplaced)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("stopped") + "echo lost engine_worker ground; " + Await("second") +
            kFinishing);
  Add("engine_worker ground", Tell("stopped") + "kill -STOP $$; " + Tell("came back"));
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_FALSE(IsTold("came back"));
}

TEST_F(SupervisorTest, OneThatIsStoppedBeforeAnybodyKnowsItIsKilledAndReplaced)
{
  retries_ = 1;
  times_.stopped = milliseconds(60);
  AddServer("echo state running; " + Await("second") + kFinishing);
  Add("engine_worker ground", "kill -STOP $$; " + Tell("came back"));
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_FALSE(IsTold("came back"));
}

TEST_F(SupervisorTest, OneThatSaysWhatIsWrongIsNotReplaced)
{
  retries_ = 3;
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "exit 4");
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
  EXPECT_FALSE(IsTold("second"));
}

TEST_F(SupervisorTest, WhatIsOnTheScreenAlreadyIsNotShownAgain)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("second") + kFinishing);
  Add("visualiser", "echo one; echo two; printf half; sleep 0.2; kill -9 $$", MemberPlan::kScreen);
  ReplaceBy("echo one; echo two; echo half and half; " + Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_EQ(ScreenText(), "one\ntwo\nhalf and half\n");
}

TEST_F(SupervisorTest, StopsProcessesThatIgnoreSigterm)
{
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", Await("deaf") + "exit 1");
  Add("controller_host 0", "trap '' TERM; " + Tell("deaf") + "while true; do sleep 1; done");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
}

TEST_F(SupervisorTest, StopsProcessesThatAreStopped)
{
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", Await("stopping") + "exit 1");
  Add("controller_host 0", Tell("stopping") + "kill -STOP $$");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
}

TEST_F(SupervisorTest, AServerThatEndsWithoutAResultFailed)
{
  times_.settle = milliseconds(60);
  AddServer("echo state running; echo error the arena is empty");
  Add("engine_worker ground", "exec sleep 600");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(
      outcome.reason.starts_with("space_server ended before the last tick at tick 0 (the arena is empty); its log is "))
      << outcome.reason;
}

TEST_F(SupervisorTest, AWorkerThatEndsEarlyFailed)
{
  times_.early_end = milliseconds(200);
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "exit 0");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground ended before the last tick at tick 7"))
      << outcome.reason;
}

TEST_F(SupervisorTest, AResultThatComesAfterAProcessWasKilledIsNone)
{
  AddServer(std::string("trap 'echo finished 7 2 00000000000000ff 0.2 2.5; exit 0' TERM; echo state running; ") +
            Tell("running") + "while true; do sleep 0.01; done");
  Add("visualiser", Await("running") + "kill -KILL $$");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("visualiser was killed by signal 9")) << outcome.reason;
  EXPECT_FALSE(outcome.finished.has_value());
}

TEST_F(SupervisorTest, AWorkerMayEndLongBeforeTheServersLastWordOnceItHasLeft)
{
  AddServer("echo state running; echo left engine_worker ground; " + Tell("left") + Await("ended") + LetAnHourPass() +
            kFinishing);
  Add("engine_worker ground", Await("left") + Tell("ended") + "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, TheWordThatAWorkerHasLeftMayComeAfterItsEnd)
{
  // As on another machine.
  AddServer("echo state running; " + Await("ended") + "echo left engine_worker ground; " + kFinishing);
  Add("engine_worker ground", Tell("ended") + "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, BlamesTheOneThatTheServerAccuses)
{
  AddServer("echo state running; echo \"error engine 'ground': division by zero\"; " + Tell("accused") + "exit 4");
  Add("controller host 0", Await("accused") + Tell("host ends") + "exit 4");
  Add("engine 'ground'", Await("host ends") + "sleep 0.05; echo division by zero; exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with(
      "engine 'ground' ended with exit code 4 at tick 0 (engine 'ground': division by zero)"))
      << outcome.reason;
}

TEST_F(SupervisorTest, ThoseThatEndForAnotherAreNotItsHeadline)
{
  AddServer("echo state running; " + Await("engine ends") + "echo \"error controller host 0 failed\"; " +
            Tell("accused") + "exit 6");
  Add("engine 'ground'", Tell("engine ends") + "exit 6");
  Add("controller host 0", Await("accused") + "sleep 0.05; exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_TRUE(outcome.reason.starts_with("controller host 0 ended with exit code 4")) << outcome.reason;
}

TEST_F(SupervisorTest, IfNobodyFailedTheServerSaysWhy)
{
  AddServer("echo state running; " + Await("engine ends") +
            "echo \"error engine 'far' does not answer any more\"; exit 6");
  Add("engine 'ground'", Tell("engine ends") + "exit 6");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine 'far' does not answer any more; the log of space_server is "))
      << outcome.reason;
}

TEST_F(SupervisorTest, AWorkerMayEndJustBeforeTheServersLastWord)
{
  AddServer(Await("worker ends") + kFinishing);
  Add("engine_worker ground", Tell("worker ends") + "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AnInvalidExperimentIsToldApart)
{
  times_.settle = milliseconds(60);
  AddServer(Running());
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
  times_.finish_visualiser = std::chrono::hours(2);
  AddServer(std::string(kFinishing) + "; " + Tell("finished"));
  Add("visualiser", Await("finished") + AwaitEndOfServer() + LetAnHourPass(), MemberPlan::kScreen);
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AWorkerThatNeverEndsFailed)
{
  AddServer(std::string(kFinishing) + "; " + Tell("finished"));
  Add("engine_worker ground", Await("finished") + AwaitEndOfServer() + LetAnHourPass() + "exec sleep 600");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground did not end within 1 min 40 s of the last tick"))
      << outcome.reason;
}

TEST_F(SupervisorTest, OneInterruptStopsAtATickAndKeepsTheResult)
{
  AddServer(Stoppable());
  Add("engine_worker ground", "sleep 0.5");
  const std::jthread press = PressAt({{"running", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  ASSERT_TRUE(outcome.finished);
  EXPECT_EQ(outcome.finished->ticks, 8U);
}

// The server waits for all to leave.
TEST_F(SupervisorTest, OneThatDiesWhileTheRunStopsIsReplaced)
{
  retries_ = 1;
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Tell("running") + Await("second") +
            "echo finished 8 2 00000000000000aa 0.3 1.5");
  Add("controller_host 0", Await("asked") + "kill -ABRT $$");
  ReplaceBy(Tell("second"));
  const std::jthread press = PressAt({{"running", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted) << outcome.reason;
  ASSERT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, OneThatDiesWhileTheRunStopsAndIsNotReplacedIsNamed)
{
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Tell("running") +
            "while true; do sleep 0.05; done");
  Add("controller_host 0", Await("asked") + "kill -ABRT $$");
  const std::jthread press = PressAt({{"running", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("controller_host 0 was killed by signal 6")) << outcome.reason;
}

TEST_F(SupervisorTest, StartsAllAgainToTryMoreControllerHosts)
{
  AddServer("i=0; echo state running; while true; do i=$((i+10)); echo tick $i 0 2.5; sleep 0.02; done");
  ReplaceBy(Await("second host of incarnation 1") + kFinishing);
  std::string second_at;
  const auto add_host = [&](std::size_t host, const std::string& again)
  {
    Add("controller host " + std::to_string(host), "exec sleep 600");
    ReplaceBy(again);
    plans_.back().may_fail = [](std::uint32_t) { return false; };
    plans_.back().place = [](const std::string&) {};
  };
  add_host(0, "exit 0");
  plans_.back().host = "beta";
  ProgressDisplay display(ProgressDisplay::Style::kQuiet, 2);
  Supervisor supervisor(
      spawner_, interrupts_, display, screen_write_.Get(), {}, times_, [this] { return Now(); }, 3);
  std::vector<unsigned> tried;
  supervisor.SetPlanAgain(
      [&](unsigned hosts)
      {
        tried.push_back(hosts);
        const std::vector<MemberPlan> first = plans_;
        add_host(1, "");
        plans_.back().place = [&](const std::string& host) { second_at = host.empty() ? "here" : host; };
        plans_.back().replacement = [this](unsigned incarnation, double, const std::vector<ControllerDeath>&)
        {
          const std::string mark = "second host of incarnation " + std::to_string(incarnation) + "";
          return ProcessCommand{"", {"/bin/sh", "-c", Tell(mark)}, {}, {}};
        };
        return std::exchange(plans_, first);
      });
  supervisor.SetHostChoice(HostChoice(2));
  const ClusterOutcome outcome = supervisor.Run(plans_);
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_EQ(tried, std::vector<unsigned>{2});
  EXPECT_EQ(second_at, "here");
  for (const pid_t pid : supervisor.Pids()) EXPECT_TRUE(GroupIsGone(pid));
}

TEST_F(SupervisorTest, OneWhoseOfferedMachineHasGoneIsReplacedHere)
{
  retries_ = 2;
  std::vector<std::string> placed;
  AddServer("echo state running; " + Await("second") + kFinishing);
  Add("controller_host 0", fmt::format("exit {}", static_cast<int>(kExitMachineGone)));
  ReplaceBy(Tell("second"));
  plans_.back().host = "beta";
  plans_.back().place = [&](const std::string& host) { placed.push_back(host.empty() ? "here" : host); };
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_EQ(placed, std::vector<std::string>{"here"});
}

TEST_F(SupervisorTest, OneThatIsKilledOnceItHasLeftChangesNothing)
{
  retries_ = 1;
  AddServer("echo state running; echo left engine_worker ground; " + Tell("left") + Await("killed") + kFinishing);
  Add("engine_worker ground", Await("left") + "sleep 0.1; " + Tell("killed") + "kill -9 $$");
  ReplaceBy(Tell("replaced"));
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_FALSE(IsTold("replaced"));
}

// The word that it has left was on its way: the other one finds no place any more.
TEST_F(SupervisorTest, OneThatIsReplacedAfterItHasLeftChangesNothing)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("replaced") + "echo left engine_worker ground; " + Tell("left") +
            Await("refused") + kFinishing);
  Add("engine_worker ground", "kill -9 $$");
  ReplaceBy(Tell("replaced") + Await("left") + "sleep 0.1; " + Tell("refused") + "exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
}

TEST_F(SupervisorTest, TwoInterruptsKill)
{
  // The second one comes once the first was passed on: two signals that are pending at once are one.
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Tell("running") +
            "while true; do sleep 0.05; done");
  Add("controller_host 0", "trap '' TERM; while true; do sleep 1; done");
  const std::jthread press = PressAt({{"running", SIGINT}, {"asked", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_FALSE(outcome.finished);
}

TEST_F(SupervisorTest, SigtermEndsEvenAStuckRun)
{
  times_.forced_stop = milliseconds(200);
  AddServer("trap '' INT TERM; echo state running; " + Tell("running") + "while true; do sleep 1; done");
  const std::jthread press = PressAt({{"running", SIGTERM}});
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
}

TEST_F(SupervisorTest, ShowsWhatVisualisersWriteToTheScreen)
{
  AddServer(std::string("echo a line for the log; ") + kFinishing + "; " + Tell("finished"));
  // It ends after the server, as visualisers do; one that ends before is a failure.
  Add("visualiser", "echo one; echo two; echo aside >&2; " + Await("finished") + AwaitEndOfServer(),
      MemberPlan::kScreen);
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_EQ(ScreenText(), "one\ntwo\n");
  EXPECT_EQ(LogText("visualiser"), "aside\n");
  EXPECT_EQ(LogText("space_server"), "a line for the log\n");
}

TEST_F(SupervisorTest, AFullScreenDoesNotDeafenIt)
{
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Await("writing") + Tell("running") +
            "while true; do sleep 0.05; done");
  Add("visualiser", "trap 'exit 0' TERM; " + Tell("writing") + "yes", MemberPlan::kScreen);
  const std::jthread press = PressAt({{"running", SIGINT}, {"asked", SIGINT}});
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
}

TEST_F(SupervisorTest, StopsWhenNobodyReadsTheScreen)
{
  AddServer(Stoppable());
  Add("visualiser", Await("running") + "for i in 1 2 3; do echo line; sleep 0.05; done", MemberPlan::kScreen);
  screen_read_.Reset();
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, AMissingProgramIsNamedAndNothingIsLeft)
{
  AddServer(Running());
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
  ClusterMemberTest() { std::filesystem::create_directories(folder_); }
  ~ClusterMemberTest() override { std::filesystem::remove_all(folder_); }

  MemberPlan Visualiser(const std::string& script) const
  {
    MemberPlan plan;
    plan.command.name = "visualiser";
    plan.command.arguments = {"/bin/sh", "-c", script};
    plan.log_path = folder_ / "visualiser.log";
    plan.output = MemberPlan::kScreen;
    return plan;
  }

  const std::filesystem::path folder_ = testing::TempDir() + "swarmanoid_member_" + std::to_string(getpid());
  SystemSpawner spawner;
};

TEST_F(ClusterMemberTest, TheLastWordsOfAProcessAreInItsLog)
{
  const MemberPlan plan = Visualiser("echo one >&2; printf two >&2; exit 3");
  {
    ClusterMember member(plan, spawner);
    member.Collect(spawner);
    EXPECT_EQ(member.End()->exit_code, 3);
  }
  std::ostringstream text;
  text << std::ifstream(plan.log_path).rdbuf();
  EXPECT_EQ(text.str(), "one\ntwo\n");
}

// A process of a user's code may leave a child behind, in a session of its own, that keeps the output open.
TEST_F(ClusterMemberTest, OutputEndsWithItsProcessWhoeverElseHoldsItOpen)
{
  ClusterMember member(Visualiser("setsid sh -c 'echo $$; exec sleep 600' & exec sleep 600"), spawner);
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
  EXPECT_EQ(kill(left_behind, 0), 0) << "nobody held the output open";
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
