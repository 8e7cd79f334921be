// Supervisor: starts the processes of a plan, watches them until the last one has ended, and says how it went. A
// process that dies is replaced. If that does not help, as for the space server, all processes are replaced. If a
// process fails, or dies again and again, all are stopped. The supervisor owns the processes and the plan. It runs in
// one thread, which it blocks.
//
// Each turn of its loop waits for an event, reads all outputs, collects the processes that ended, and then looks at
// signals and times. `Phase` says what the run is at; every change of the phase is one of these:
//
//   kRunning    -> kStopping    a user asks for the end, or standard output has no reader
//               -> kRestarting  a process died that cannot be replaced alone, or the number of controller hosts changes
//   kRestarting -> kRunning     all processes have ended, and start again
//   kRunning, kStopping -> kFinishing   the space server has told the result
//   kFinishing  -> kRestarting  the space server died before its exit code was known
//   all         -> kDying       a process failed, a user asks again, or a time is over: SIGTERM is sent, SIGKILL
//   follows
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/program/process.h"
#include "common/run/server_status.h"
#include "launcher/supervision/attribution.h"
#include "launcher/supervision/cluster_member.h"
#include "launcher/supervision/cluster_plan.h"
#include "launcher/supervision/progress_display.h"
#include "launcher/supervision/signal_descriptor.h"

namespace swarmanoid
{

struct ClusterOutcome
{
  enum Kind
  {
    kFinished,
    kUnsuccessful,  // finished, and failed by the experiment's own measure
    kInterrupted,   // stopped at the end of a tick, or killed on request
    kFailed,        // a process failed
    kInvalid        // a process found the experiment itself wrong
  };
  Kind kind = kFailed;
  std::optional<ServerFinished> finished;  // set if the space server came to its end
  std::optional<ServerReset> reset;        // the run begins again on request
  std::string reason;                      // for a failure: one line that names the process, the tick and the log
  std::vector<std::string> log_lines;      // the last log lines of that process
  std::vector<std::pair<std::string, std::string>> processes;  // names and logs of all that were planned
};

// The facts about a run that the supervisor needs besides its plan.
struct SupervisedRun
{
  std::function<ProcessCommand(const ClusterPlan& plan, std::size_t process, const Incarnation& incarnation)>
      command_of;
  ActorNames actor_of{};
  std::function<bool(std::uint32_t robot)> may_fail{};  // whether the run goes on if its controller fails; empty: never
  unsigned retries = 0;  // how often a process is replaced while the run makes no progress
};

// Times that users notice; tests shorten them.
struct SupervisorTimes
{
  std::chrono::milliseconds refresh{200};      // between two updates of the progress
  std::chrono::milliseconds stall{2000};       // silence of the space server that is reported
  std::chrono::milliseconds terminate{400};    // between SIGTERM and SIGKILL after a failure
  std::chrono::milliseconds early_end{10000};  // between a process's good end and the server's report of its Leave
  std::chrono::milliseconds settle{200};  // between a failure and its attribution, since the cause may be reported late
  // After a process ended because of another one, the end of that other one is awaited for this time.
  std::chrono::milliseconds others{3000};
  std::chrono::milliseconds finish{30000};  // for processes to end after the last tick; a busy disk delays the journal
  std::chrono::milliseconds finish_visualiser{60000};  // visualisers may have films to finish
  std::chrono::milliseconds forced_stop{5000};         // after SIGTERM or SIGHUP to the launcher
  // How long a worker may be stopped by a signal before it is replaced; 0: no limit.
  std::chrono::milliseconds stopped{0};
};

class Supervisor
{
public:
  using Clock = std::chrono::steady_clock;

  // All references outlive the supervisor. `screen`: descriptor that gets what visualisers write to standard output.
  // `now`: the clock by which all times are measured.
  Supervisor(ProcessSpawner& spawner, SignalDescriptor& interrupts, ProgressDisplay& display, int screen,
             SupervisedRun run, const SupervisorTimes& times = {}, std::function<Clock::time_point()> now = Clock::now);

  ClusterOutcome Run(ClusterPlan plan);
  // Returns all processes that were started, so that tests can find what they leave behind.
  const std::vector<pid_t>& PidsForTest() const { return pids_; }

private:
  enum class Phase
  {
    kRunning,
    kRestarting,  // all are killed to start again where the journal ends
    kStopping,    // the end is requested: the space server ends at its tick
    kFinishing,   // the last tick is done, processes end
    kDying        // SIGTERM is sent, SIGKILL follows
  };

  // The lines that a visualiser has written, and those already shown.
  struct Screen
  {
    unsigned incarnation = 0;
    std::uint64_t shown = 0;
    std::uint64_t lines = 0;
  };

  // These functions start processes and read what they report.
  void Start();
  std::unique_ptr<ClusterMember> StartProcess(std::size_t process, Incarnation incarnation);
  void WaitForEvents();
  void ReadMember(ClusterMember& member);
  void WriteScreen(const ClusterMember& member, std::string_view line);
  void ShowProgress();
  bool AnyAlive() const;

  // Status lines of the space server.
  void Take(const ServerState& state);
  void Take(const ServerTick& tick);
  void Take(const ServerStall& stall);
  void Take(const ServerAsked& asked) { display_.Note(asked.text); }
  void Take(const ServerWarning& warning);
  void Take(const ServerError& error) { server_error_ = error.text; }
  void Take(const ServerLeft& left) { left_.insert(left.text); }
  void Take(const ServerLost& lost);
  void Take(const ServerMove& move);
  void Take(const ServerHosts& hosts);
  void Take(const ServerReset& reset) { outcome_.reset = reset; }
  void Take(const ServerFinished& finished);

  // Ends, and which process failed first.
  void CollectEnds();
  void TakeEnd(const ClusterMember& member);
  // Returns whether nothing that happens to the process changes the run: it has left in good order.
  bool IsDone(const ClusterMember& member) const;
  void AttributeWithin(std::chrono::milliseconds patience);
  // Finds the process that failed first among those that have ended or reported a failure. If there is one, ends the
  // run.
  void Attribute();
  std::string TextOf(const ClusterMember& failed) const;

  // These functions replace one process.
  bool Replace(const ClusterMember& member);  // returns false if that does not help
  // Counts the death of a process. Returns false if the limit is exceeded, or the cause is the same as before.
  bool CountDeath(const ClusterMember& member);
  // A controller that died with the process, that may fail, and that has not died there before.
  std::optional<ControllerDeath> NewDeath(const ClusterMember& member) const;
  // Returns whether the process died on its way to another machine, which the run waits for.
  bool IsOnItsWay(const ClusterMember& member) const;
  void KillStopped();

  // These functions replace all processes.
  bool Restart(const ClusterMember& first, Evidence evidence);  // returns false if that does not help
  void KillToStartAgain();
  bool MustStartAgain();
  void StartAgain();

  // Ending the run.
  void TakeInterrupts();
  void StopAtTick(std::string_view why);
  void CheckDeadlines();
  void Fail(const ClusterMember& member, const std::string& text, bool complete);
  void Die(Clock::time_point kill_at);
  void KillAll();
  void SignalAll(int signal);

  // These members stay as they are after construction.
  ProcessSpawner& spawner_;
  SignalDescriptor& interrupts_;
  ProgressDisplay& display_;
  const int screen_;
  const SupervisedRun run_;
  const SupervisorTimes times_;
  const std::function<Clock::time_point()> now_;

  Phase phase_ = Phase::kRunning;
  ClusterOutcome outcome_;
  std::optional<Clock::time_point> deadline_;  // deadline of the phase

  ClusterPlan plan_;
  std::vector<std::unique_ptr<ClusterMember>> members_;  // in the order of the plan, but while all start again
  std::vector<pid_t> pids_;

  // The last reports of the space server.
  std::optional<Clock::time_point> began_;  // its first tick
  Clock::time_point heard_{};               // when it last said anything
  std::string server_error_;
  std::set<std::string> left_;  // workers that may end
  std::set<std::string> lost_;  // workers that the server does not hear any more

  std::map<std::string, DeathCount> deaths_;
  std::map<std::string, std::string> moves_;  // machines of workers that were killed to move them there
  // The former machines of workers that were moved while the run was at the tick.
  std::map<std::string, std::pair<std::string, std::uint64_t>> came_from_;
  std::map<pid_t, Clock::time_point> stopped_;  // by process: since when it is stopped
  std::vector<const ClusterMember*> ended_;     // processes that ended too early or badly, in the order of discovery
  std::optional<Clock::time_point> attribute_at_;
  std::uint64_t kills_for_memory_;  // number of kills by the kernel before the run

  RunProgress progress_;
  Clock::time_point shown_{};
  std::string shown_phase_;
  std::map<std::string, Screen> screens_;
  bool screen_full_ = false;  // the screen takes no more bytes now, so visualisers wait
  bool screen_gone_ = false;
};

}  // namespace swarmanoid
