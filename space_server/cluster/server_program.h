// ServerProgram: the main thread of the space_server program. It starts the run, paces it, answers users, reports late
// processes, and ends the run. The ticks themselves run in threads of the bus (Lockstep).
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/activity/failure_report.h"
#include "common/bus/membership/server_session.h"
#include "common/bus/membership/status_channel.h"
#include "common/bus/membership/worker_world.h"
#include "common/run/run_settings.h"
#include "common/threads/waiting.h"
#include "space_server/cluster/checkpoint_writer.h"
#include "space_server/cluster/lockstep.h"
#include "space_server/cluster/recovery_service.h"
#include "space_server/cluster/restart_point.h"
#include "space_server/cluster/view_publisher.h"
#include "space_server/pace_meter.h"
#include "space_server/run_control.h"
#include "space_server/space_server.h"

namespace swarmanoid
{

struct ServerOptions : RunSettings
{
  int status_fd = -1;
  // The launcher replaces processes that die.
  bool awaits_replacements = false;
  // The seconds that the run took before it is resumed from the journal in the output folder. Negative: a new run
  // starts.
  double goes_on_after_s = -1;
  BusOptions bus;
  // The positions of workers, "WORKER=MACHINE", and all machines, if the launcher can move workers. Otherwise both are
  // empty.
  std::vector<std::string> worker_places;
  std::vector<std::string> machines;
  // Called before the state of each tick is sent, in the thread that runs the program. Its changes to the server are
  // part of the state.
  std::function<void(SpaceServer&)> watch;
  // In a process that lives on after the run: set if the run is to be given up at once.
  const std::atomic<bool>* abandon = nullptr;
  std::string places;  // LoadedExperiment::places
};

class ServerProgram
{
public:
  // All are used as long as the program runs. Throws ConfigurationError and BusError.
  ServerProgram(const ServerOptions& options, const Experiment& experiment, StatusChannel& status);
  ~ServerProgram()
  {
    grants_.Stop();
    session_.Close();
  }
  ServerProgram(const ServerProgram&) = delete;
  ServerProgram& operator=(const ServerProgram&) = delete;

  // The whole run. Returns the exit code. If the run has failed, threads of the bus may be stuck for ever: then the
  // program is not to be destroyed, and the process ends by EndAtOnce.
  int Run();
  bool Failed() const { return failed_; }

private:
  using Clock = RunClock;

  // Between repetitions of what others may not have heard: at first, and at most.
  static constexpr std::chrono::milliseconds kFirstRepeat{100}, kLastRepeat{1000};

  static double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }
  // Returns the assignment of robots to hosts by the positions at which the run starts or resumes.
  HostTable Hosts() const;
  // Returns the description of the run for its processes, with the same positions.
  WorldMessage World();
  std::span<const RenderConfiguration> Visualisers() const;
  std::vector<std::string> Expected(std::span<const RenderConfiguration> visualisers) const;
  // All processes of the run: these with the visualisers of the file, and the regions of engines that are split, which
  // answer their engine alone and remember nothing.
  std::vector<std::string> Members() const;
  bool IsInterrupted() const { return options_.stop != nullptr && *options_.stop; }
  void Wake();
  void Sleep(Clock::time_point until);
  bool GoesOn() const { return options_.goes_on_after_s >= 0; }
  std::set<std::uint64_t> SavedTicks() const;
  bool KeepsJournal() const { return options_.journal && !options_.output_folder.empty(); }
  void OpenJournal();
  RunControlSetup Setup();
  void Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text);
  JournalWriter* Journal() { return journal_ ? &*journal_ : nullptr; }
  void CheckFailures();
  // Sends the journal to processes that replace others, and then the current state again.
  void HelpReplacements();
  void Say(const std::string& text) const;
  // Announces the run to processes that have not heard of it, at most once in a fixed time.
  void SayWorldAgain();
  // Waits until all processes of the run have joined.
  void Collect();
  void RunTicks();
  void ReportState();
  // Reports the tick to the launcher, which uses it to decide whether to replace a process that dies.
  void TellTick();
  // Progress, late answers, stalls.
  void ReportProgress();
  // Returns true if the run has waited long since since_ and has not reported it lately.
  bool StallIsDue() const;
  void ReportStall(const std::string& who);
  // Returns the names of the processes that the run waits for: those of missing answers, or the processes that these
  // wait for.
  std::string LateNames(std::uint64_t tick) const;
  RunStatus::Phase Phase() const;
  // Returns true if the run begins again after a reset. Observers then wait for the next server and get no end of the
  // run.
  bool BeginsAgain() const { return run_control_.Reset().has_value() && KeepsJournal(); }
  // Attached visualisers see the whole state now and then, and how the run goes.
  void PublishViews();
  RunStatus Status(RunStatus::Phase phase, Clock::time_point now);
  // The last state is out: all draw it, close their files and leave.
  void Close();
  // All parts have been sent; the last of them may still be on their way through the threads of the bus.
  void FinishCheckpoints();

  const ServerOptions& options_;
  const Experiment& experiment_;
  StatusChannel& status_;
  std::mutex wake_mutex_;  // guards awake_
  RunCondition wake_;
  bool awake_ = false;
  std::optional<RestartPoint> restart_point_;
  std::optional<Checkpoint> restored_;  // until the journal has it
  Assignment assignment_;
  SpaceServer server_;
  ServerSession session_;
  AccessGrants grants_;
  ViewPublisher views_;
  RunControl run_control_;
  PaceMeter pace_;
  std::optional<JournalWriter> journal_;
  CheckpointWriter checkpoints_;
  Lockstep lockstep_;
  RecoveryService recoveries_;

  Clock::time_point start_;
  Clock::time_point end_;
  std::optional<ServerState::Phase> said_phase_;
  std::uint64_t last_tick_ = 0;
  std::optional<std::uint64_t> told_tick_;
  Clock::time_point since_;  // the current tick is waited for
  Clock::time_point repeated_;
  Clock::time_point world_said_;
  Clock::duration repeat_after_{};
  Clock::duration stall_said_{};
  std::uint64_t first_tick_ = 0;
  bool started_ = false;
  bool told_end_ = false;
  bool failed_ = false;
  std::optional<Clock::time_point> broken_since_;
  std::uint64_t broken_tick_ = 0;
  bool stuck_ = false;
  EndReason reason_ = EndReason::kFailed;  // why the run ends before its end
  SpaceSnapshot snapshot_;
};

}  // namespace swarmanoid
