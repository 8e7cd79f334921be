// Supervisor: starts the processes of a cluster, watches them until the last one has ended, and says how it went. Who
// dies is replaced by another process, or if that is no use, as for the space server, all of them are; when one fails,
// or dies again and again, all are stopped at once. Owns the processes; used by the launcher's main thread, which it
// blocks.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/program/process.h"
#include "common/run/server_status.h"
#include "launcher/supervision/attribution.h"
#include "launcher/supervision/cluster_member.h"
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
  std::optional<ServerFinished> finished;  // if the space server came to its end
  std::optional<ServerReset> reset;        // it is to begin again
  std::string reason;                      // of a failure: one line that names who failed, the tick and the log
  std::vector<std::string> log_lines;      // the last ones of that process
};

// Times that users notice; tests shorten them.
struct SupervisorTimes
{
  std::chrono::milliseconds refresh{200};      // between two looks at the progress
  std::chrono::milliseconds stall{2000};       // silence of the space server that is worth a word
  std::chrono::milliseconds terminate{400};    // between SIGTERM and SIGKILL after a failure
  std::chrono::milliseconds early_end{10000};  // between a process's good end and the server's word that it left
  std::chrono::milliseconds settle{200};       // between a failure and its attribution: a cause may be told late
  std::chrono::milliseconds others{3000};      // between the end of one that ended for another, and that one's
  std::chrono::milliseconds finish{10000};     // for processes to end after the last tick
  std::chrono::milliseconds finish_visualiser{60000};  // visualisers may have films to finish
  std::chrono::milliseconds forced_stop{5000};         // after SIGTERM or SIGHUP to the launcher
  std::chrono::milliseconds stopped{0};  // that a worker may be stopped by a signal before it is replaced; 0: any
};

class Supervisor
{
public:
  using Clock = std::chrono::steady_clock;

  // All references outlive the supervisor. `screen`: descriptor that gets what visualisers write to standard output.
  // `actor_of`: of the experiment. `now`: by which all times are measured. `retries`: how often a process is replaced
  // while the run does not go on.
  Supervisor(ProcessSpawner& spawner, SignalDescriptor& interrupts, ProgressDisplay& display, int screen,
             ActorNames actor_of = {}, const SupervisorTimes& times = {},
             std::function<Clock::time_point()> now = Clock::now, unsigned retries = 0);

  // The processes of the run with another number of controller hosts, for users who ask for it.
  using PlanAgain = std::function<std::vector<MemberPlan>(unsigned controller_hosts)>;
  void SetPlanAgain(PlanAgain plan_again) { plan_again_ = std::move(plan_again); }
  // The first plan is the space server's.
  ClusterOutcome Run(const std::vector<MemberPlan>& plans);
  // Of all processes that were started; for what they leave behind.
  const std::vector<pid_t>& PidsForTest() const { return pids_; }

private:
  enum class Phase
  {
    kRunning,
    kRestarting,  // all are killed, and start again where the journal ends
    kStopping,    // asked for once: the space server ends at its tick
    kFinishing,   // the last tick is done, processes end
    kDying        // SIGTERM is sent, SIGKILL follows
  };

  void Start(const std::vector<MemberPlan>& plans);
  void WaitForEvents();
  void ReadMember(ClusterMember& member);
  void TakeStatus(const ServerStatus& status);
  void TakeWarning(ClusterMember& member, const ServerWarning& warning);
  void CollectEnds();
  void TakeEnd(const ClusterMember& member);
  void AttributeWithin(std::chrono::milliseconds patience);
  bool IsDone(const ClusterMember& member) const;
  // Starts another process in the place of one that died; false if that is no use.
  bool Replace(const ClusterMember& member);
  // Ends all, to start them again; false if that is no use.
  bool Restart(const ClusterMember& first, Evidence evidence);
  void KillToStartAgain();
  void StartAgain();
  bool MustStartAgain();
  // Another one that died while the run did not go on. False if it is one too many, or dies of the same again.
  bool CountDeath(const ClusterMember& member);
  void KillLost(const std::string& name);
  // Kills a worker, so that another process takes its place where a user wants it.
  void Move(const ServerMove& move);
  // Ends all, to start them again with other controller hosts.
  void ShareOut(const std::vector<std::string>& machines);
  // Whether the member died on its way to another place, which the run waits for.
  bool IsOnItsWay(const ClusterMember& member) const;
  void KillStopped();
  // Ends the run by the fault of the process that failed first, if any of those that have ended, or said so, failed.
  void Attribute();
  void TakeInterrupts();
  void StopAtTick(std::string_view why);
  void CheckDeadlines();
  void Fail(const ClusterMember& member, const std::string& text, bool complete);
  void Die(Clock::time_point kill_at);
  void KillAll();
  void SignalAll(int signal);
  std::string TextOf(const ClusterMember& failed) const;
  void ShowProgress();
  void WriteScreen(const ClusterMember& member, std::string_view line);
  bool AnyAlive() const;

  ProcessSpawner& spawner_;
  SignalDescriptor& interrupts_;
  ProgressDisplay& display_;
  int screen_;
  SupervisorTimes times_;
  std::function<Clock::time_point()> now_;

  // Of one name, while the run does not go on.
  struct Deaths
  {
    unsigned count = 0;
    std::uint64_t tick = 0;
    ActivityRecord last;
  };

  // Of one name: lines that the process has written, and those that were shown.
  struct Screen
  {
    unsigned incarnation = 0;
    std::uint64_t shown = 0;
    std::uint64_t lines = 0;
  };

  std::vector<std::unique_ptr<ClusterMember>> members_;
  std::map<std::string, Screen> screens_;
  unsigned retries_;
  std::map<std::string, Deaths> deaths_;
  std::map<std::string, std::string> moves_;  // of workers that were killed for it, to which machine
  // Of workers that were moved while the run was at the tick: where they came from.
  std::map<std::string, std::pair<std::string, std::uint64_t>> came_from_;
  std::map<pid_t, Clock::time_point> stopped_;  // since when
  std::vector<pid_t> pids_;
  PlanAgain plan_again_;
  std::vector<MemberPlan> next_plans_;  // if others than now are to start again
  Phase phase_ = Phase::kRunning;
  ClusterOutcome outcome_;
  RunProgress progress_;
  std::string server_error_;
  Clock::time_point shown_{};
  std::string shown_phase_;
  bool screen_full_ = false;  // it takes no more for now: visualisers wait
  bool screen_gone_ = false;
  std::optional<Clock::time_point> began_;   // its first tick
  Clock::time_point heard_{};                // when the server last said anything
  std::set<std::string> left_;               // said so to the server, and may end
  std::vector<const ClusterMember*> ended_;  // too early or badly, in the order in which that was noticed
  std::optional<Clock::time_point> attribute_at_;
  ActorNames actor_of_;
  std::uint64_t kills_for_memory_;             // by the kernel, before the run
  std::optional<Clock::time_point> deadline_;  // of the phase
};

}  // namespace swarmanoid
