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
#include "common/run/run_options.h"
#include "common/threads/waiting.h"
#include "space_server/cluster/checkpoint_writer.h"
#include "space_server/cluster/journal_sender.h"
#include "space_server/cluster/lockstep.h"
#include "space_server/cluster/restart_point.h"
#include "space_server/cluster/view_publisher.h"
#include "space_server/pace_meter.h"
#include "space_server/run_control.h"
#include "space_server/space_server.h"
#include "space_server/tick_wait.h"

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
  // It is called before the state of each tick is sent, in the thread that runs the program. Its changes to the server
  // are part of the state.
  std::function<void(SpaceServer&)> watch;
  // For a process that continues after the run: set if the run must be given up at once.
  const std::atomic<bool>* abandon = nullptr;
  std::string places;  // LoadedExperiment::places
};

class ServerProgram
{
public:
  // The program uses the arguments as long as it runs. Throws ConfigurationError and BusError.
  ServerProgram(const ServerOptions& options, const Experiment& experiment, StatusChannel& status);
  ~ServerProgram()
  {
    grants_.Stop();
    session_.Close();
  }
  ServerProgram(const ServerProgram&) = delete;
  ServerProgram& operator=(const ServerProgram&) = delete;

  // Does the whole run and returns the exit code. If the run has failed, threads of the bus may be stuck for ever. Then
  // the program must not be destroyed, and the process ends by EndAtOnce.
  int Run();
  bool Failed() const { return stage_ == Stage::kFailed; }

private:
  using Clock = RunClock;

  enum class Stage
  {
    kGathering,  // not all processes have joined
    kRunning,
    kFailed
  };
  // A dead process holds a lock of the run's shared memory, and the run is still at this tick.
  struct Broken
  {
    std::uint64_t tick;
    Clock::time_point since;
  };

  static double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }
  // Returns the assignment of robots to hosts by the positions at which the run starts or resumes.
  HostTable Hosts() const;
  // Returns the description of the run for its processes, with the same positions.
  WorldMessage World();
  std::span<const RenderConfiguration> Visualisers() const;
  std::vector<std::string> Expected(std::span<const RenderConfiguration> visualisers) const;
  // Returns all processes of the run: the expected ones, the visualisers of the file, and the regions of split engines.
  // Regions answer only their engine and save no state.
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
  // Reports progress, late answers and stalls.
  void ReportProgress();
  void ReportStall(const std::string& who, Clock::duration waited);
  // Returns the names of the processes that the run waits for: those of missing answers, or the processes that these
  // wait for.
  std::string LateNames(std::uint64_t tick) const;
  RunStatus::Phase Phase() const;
  // Returns true if the run begins again after a reset. Observers then wait for the next server and get no end of the
  // run.
  bool BeginsAgain() const { return run_control_.Reset().has_value() && KeepsJournal(); }
  // Sends attached visualisers the whole state and the status of the run, if they are due.
  void PublishViews();
  // They get the last state, unless the run begins again.
  void PublishEnd();
  void SendView(Clock::time_point now);
  RunStatus Status(RunStatus::Phase phase, Clock::time_point now);
  // Ends the run after the last state: waits until all processes have drawn it, closed their files and left, and
  // reports the result.
  void Close();
  // Waits for the last parts of checkpoints, which may still be in the threads of the bus, and writes the checkpoints.
  void FinishCheckpoints();

  const ServerOptions& options_;
  const Experiment& experiment_;
  StatusChannel& status_;
  std::mutex wake_mutex_;  // guards awake_
  RunCondition wake_;
  bool awake_ = false;
  std::optional<RestartPoint> restart_point_;
  std::optional<Checkpoint> restored_;  // released when the journal has it
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
  JournalSender journal_sender_;

  Clock::time_point start_;
  Clock::time_point end_;
  Clock::time_point answers_from_;  // before, processes that leave wait for their answers
  std::optional<ServerState::Phase> said_phase_;
  std::uint64_t last_tick_ = 0;
  std::optional<std::uint64_t> told_tick_;
  TickWait wait_;
  Clock::time_point world_said_;
  std::uint64_t first_tick_ = 0;
  Stage stage_ = Stage::kGathering;
  std::optional<Broken> broken_;
  SpaceSnapshot snapshot_;
};

}  // namespace swarmanoid
