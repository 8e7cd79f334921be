// SupervisorTest: clusters of shell scripts that behave as the real programs do, or as broken ones.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "launcher/supervision/supervisor.h"
#include "tests/eventually.h"
#include "tests/unit/launcher/process_groups.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using test::Eventually;
using test::kGenerous;

inline const char* const kFinishing =
    "echo state running; echo tick 5 5 2.5; echo finished 5 2 00000000000000ff 0.2 2.5";

class SupervisorTest : public testing::Test
{
protected:
  SupervisorTest()
  {
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

  static ProcessRole RoleOf(const std::string& name)
  {
    if (name == "space_server") return ProcessRole::kSpaceServer;
    if (name == "visualiser") return ProcessRole::kVisualiser;
    return name.starts_with("controller") ? ProcessRole::kControllerHost : ProcessRole::kEngine;
  }
  void Add(const std::string& name, const std::string& script)
  {
    plan_.processes.push_back(
        {.name = name, .role = RoleOf(name), .log_path = folder_ / (name + ".log"), .replaceable = false});
    scripts_[name].first = script;
  }
  void AddServer(const std::string& script) { Add("space_server", "echo $$ > " + Mark("server") + "; " + script); }

  // Another process may replace the one that was added last; `script` may use $1, which is its incarnation.
  void ReplaceBy(const std::string& script)
  {
    plan_.processes.back().replaceable = true;
    scripts_[plan_.processes.back().name].second = script;
  }
  ProcessCommand ScriptOf(const PlannedProcess& process, unsigned incarnation)
  {
    if (process.role == ProcessRole::kEngine && !program_.empty())
      return {.name = process.name, .arguments = {program_}};
    const auto& [first, others] = scripts_[process.name];
    return {.name = process.name,
            .arguments = {"/bin/sh", "-c", incarnation == 0 ? first : others, "sh", std::to_string(incarnation)}};
  }

  // Scripts and the test tell each other their progress by files.
  std::string Mark(const std::string& name) const { return "'" + (folder_ / name).string() + "'"; }
  std::string Tell(const std::string& name) const { return "touch " + Mark(name) + "; "; }
  std::string Await(const std::string& name) const { return "until [ -e " + Mark(name) + " ]; do sleep 0.01; done; "; }
  // Waits until the supervisor has seen the end of the server.
  std::string AwaitEndOfServer() const
  {
    return "while kill -0 $(cat " + Mark("server") + ") 2>/dev/null; do sleep 0.01; done; ";
  }
  bool IsTold(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  // An hour passes for the supervisor. It has looked at all its processes before the script continues.
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
  // Returns a script that ends at its tick once it is asked to.
  std::string Stoppable() const
  {
    return "trap 'echo finished 8 2 00000000000000aa 0.3 1.5; kill $!; exit 0' INT; echo state running; sleep 600 & " +
           Tell("running") + "wait";
  }
  // Sends signals to the test itself, each when a script has reported that name.
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
    const SupervisedRun run{.command_of =
                                [this](const ClusterPlan& plan, std::size_t process, const Incarnation& incarnation)
                            {
                              last_plan_ = plan;
                              return ScriptOf(plan.processes[process], incarnation.number);
                            },
                            .retries = retries_};
    Supervisor supervisor(spawner_, interrupts_, display, screen_write_.Get(), run, times_, [this] { return Now(); });
    const Clock::time_point start = Clock::now();
    ClusterOutcome outcome = supervisor.Run(plan_);
    EXPECT_LT(Clock::now() - start, kGenerous) << "it waited for a process that never ends";
    for (const pid_t pid : supervisor.PidsForTest())
      EXPECT_TRUE(GroupIsGone(pid)) << "a process of group " << pid << " is left";
    return outcome;
  }

  std::string LogText(const std::string& name) const { return folder_.Read(name + ".log"); }
  std::string ScreenText()
  {
    screen_write_.Reset();
    std::string text;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(screen_read_.Get(), buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(count));
    return text;
  }

  SignalDescriptor interrupts_;  // constructed first, so that threads of the tests do not get the signals
  test::TemporaryFolder folder_;
  SupervisorTimes times_;
  unsigned retries_ = 0;
  int looks_ = 0;  // number of looks at the clock since an hour passed
  SystemSpawner spawner_;
  ClusterPlan plan_;
  ClusterPlan last_plan_;                                               // the plan when the last process was started
  std::string program_;                                                 // program of engines, instead of their scripts
  std::map<std::string, std::pair<std::string, std::string>> scripts_;  // by name: the first process, and all others
  FileDescriptor screen_read_, screen_write_;
};

}  // namespace swarmanoid
