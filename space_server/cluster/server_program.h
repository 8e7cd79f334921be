// ServerProgram: the main thread of the space_server program. Starts the run, paces it, answers users, watches who is
// late, and ends it; the ticks themselves run in threads of the bus (Lockstep).
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
  // Whoever started the processes starts others in the places of those that die.
  bool awaits_replacements = false;
  // Seconds that the run has taken already whose journal is in the output folder, and which goes on; negative: it
  // starts.
  double goes_on_after_s = -1;
  BusOptions bus;
  // Of workers, if whoever started them can move them: "WORKER=MACHINE", and all machines.
  std::vector<std::string> worker_places;
  std::vector<std::string> machines;
  // Called before the state of each tick goes out, in the thread that runs the program; what it changes through the
  // server is part of the state.
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
  // By where the robots are, where the run starts or goes on.
  HostTable Hosts() const;
  // The world, likewise.
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
  // Those who take the places of others get the journal; the state goes out again for them.
  void HelpReplacements();
  void Say(const std::string& text) const;
  // For processes that have not heard of the run. Not too often.
  void SayWorldAgain();
  // Until all processes of the run are there.
  void Collect();
  void RunTicks();
  void ReportState();
  // To whoever started the run, and decides by it where those are replaced that die.
  void TellTick();
  // Progress, late answers, stalls.
  void ReportProgress();
  // Since since_ somebody has been waited for long, and it has not been said lately.
  bool StallIsDue() const;
  void ReportStall(const std::string& who);
  // Whom the run waits for: those whose answer is missing, or those whom they in turn wait for.
  std::string LateNames(std::uint64_t tick) const;
  RunStatus::Phase Phase() const;
  // Those who look on wait for the server with which the run begins again, and hear of no end.
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
  std::mutex wake_mutex_;
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
