// All roles work one after the other in this process and share one space, so no message is copied: each reads the
// results of the others through pointers, which stay. The order is that of a cluster. So both compute the same bits
// (docs/determinism.md).
//
// Invariant: in each tick the hosts go first, then the engines, and at last the server, which merges the results of
// both.
#include "simulation/simulator.h"

#include <fmt/format.h>
#include <sched.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "common/activity/failure_report.h"
#include "common/activity/shared_activity.h"
#include "common/checkpoint/checkpoint.h"
#include "common/errors/print_error.h"
#include "common/experiment/load_experiment.h"
#include "common/journal/journal_reader.h"
#include "common/journal/journal_writer.h"
#include "common/math/reproducible_math.h"
#include "common/messages/assignment.h"
#include "common/program/usage_error.h"
#include "common/run/hash_log.h"
#include "common/serialisation/save_check.h"
#include "common/space/space.h"
#include "common/threads/thread_choice.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "simulation/register_all.h"
#include "simulation/steering.h"
#include "simulation/watched_simulator.h"
#include "space_server/space_server.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Returns the cores that this process may use, minus those that the machine kept busy in the last minute; at least one.
unsigned FreeCores()
{
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  double busy = 0;
  if (getloadavg(&busy, 1) != 1) return 1;
  return static_cast<unsigned>(std::clamp(CPU_COUNT(&cores) - std::round(busy), 1.0, 64.0));
}

}  // namespace

struct CSimulator::Roles
{
  Roles(const Experiment& of, const SimulatorOptions& with, const HostTable& table, RunLink* link)
      : experiment(of),
        options(WithFolder(with)),
        assignment(MakeAssignment(of, table)),
        server(of, assignment, options.output_folder),
        space(server.Space()),
        steering(of, server, MakeRunControlSetup(of, with), with.stop),
        hash_log(with.hash_log)
  {
    server.ShareSpace();
    const unsigned threads =
        std::min(options.threads == 0 ? FreeCores() : options.threads, SharedActivity::kMostThreads);
    if (threads > 1) pool = std::make_unique<WorkerPool>(threads);
    server.UseThreads(pool.get());
    for (std::size_t e = 0; e < experiment.engines.size(); ++e)
      engines.push_back(std::make_unique<EngineWorker>(space, assignment, e, nullptr, pool.get()));
    for (std::size_t h = 0; h < assignment.hosts.size(); ++h)
    {
      hosts.push_back(std::make_unique<ControllerHost>(space, assignment, h, pool.get()));
      hosts[h]->SetCureOfDeath(
          "; in one process on_failure can help with exceptions alone: run it as a cluster, without --single-process");
      if (!options.faults_of.empty()) hosts[h]->Know(FaultsOfRun(options.faults_of, of, 0));
    }
    steering.SetHost(*hosts[0]);
    time_budgets = WatchTimeBudgets(of, assignment.hosts[0]);
    if (options.visualisations)
      for (const RenderConfiguration& render : experiment.visualisations)
        visualisers.push_back(std::make_unique<Visualiser>(render, space, assignment, options.output_folder,
                                                           &steering.Control(), &steering));
    if (link != nullptr) steering.Open(*link, assignment);
    const auto interactive = [](const auto& visualiser) { return visualiser->IsInteractive(); };
    const bool reachable = link != nullptr && link->IsOpen();
    if (options.paused && !reachable && std::none_of(visualisers.begin(), visualisers.end(), interactive))
      throw UsageError(
          "the run would stay paused: none of its visualisations is a window or a page that can resume it; leave out "
          "--paused, or run a cluster, which `swarmanoid control resume` reaches");
    for (const HostLayout& layout : assignment.hosts)
      for (auto& host_frames = frames.emplace_back(); const std::uint32_t engine : layout.frames_from)
        host_frames.push_back(&engines[engine]->Sensors());
    for (const EngineLayout& layout : assignment.engines)
      for (auto& engine_commands = commands_of_engines.emplace_back(); const std::uint32_t host : layout.commands_from)
        engine_commands.push_back(&hosts[host]->Commands());
    for (const auto& host : hosts) commands.push_back(&host->Commands());
    for (const auto& engine : engines) updates.push_back(&engine->Update());
  }

  Checkpoint TakeCheckpoint() const
  {
    Checkpoint checkpoint;
    checkpoint.origin = origin;
    server.WriteSnapshot(checkpoint.snapshot);
    const auto add = [&](const std::string& name, const auto& role)
    {
      ByteWriter state;
      role.SaveState(state);
      checkpoint.parts.push_back({name, state.Bytes()});
    };
    add(kServerPart, server);
    for (std::size_t e = 0; e < engines.size(); ++e) add(EngineName(experiment, e), *engines[e]);
    for (std::size_t h = 0; h < hosts.size(); ++h) add(HostName(h), *hosts[h]);
    return checkpoint;
  }

  void TrySavingAll() const
  {
    TrySaving(server);
    for (const auto& engine : engines) TrySaving(*engine);
    for (const auto& host : hosts) TrySaving(*host);
  }

  void Restore(const Checkpoint& checkpoint)
  {
    checkpoint.LoadPart(kServerPart, [&](ByteReader& state) { server.LoadState(checkpoint.snapshot, state); });
    for (std::size_t e = 0; e < engines.size(); ++e)
      checkpoint.LoadPart(EngineName(experiment, e), [&](ByteReader& state) { engines[e]->LoadState(state); });
    for (std::size_t h = 0; h < hosts.size(); ++h)
      checkpoint.LoadPart(HostName(h), [&](ByteReader& state) { hosts[h]->LoadState(state); });
  }

  // Writes the journal of the run from the present tick on.
  void KeepJournal(const std::string& file)
  {
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    const JournalStart beginning{origin, assignment.table, space.GetTick()};
    journal.emplace(file, ContentOf(beginning));
  }

  // Writes the tick whose state was last taken, with the frames and the commands of its step.
  void Record(bool has_commands)
  {
    recorded_frames.resize(journal_state->tick == 0 ? 0 : engines.size());
    for (std::size_t e = 0; e < recorded_frames.size(); ++e) recorded_frames[e] = engines[e]->Sensors();
    recorded_commands.resize(has_commands ? hosts.size() : 0);
    for (std::size_t h = 0; h < recorded_commands.size(); ++h) recorded_commands[h] = hosts[h]->Commands();
    journal->AddTick(*journal_state, false, recorded_frames, recorded_commands);
  }

  // Returns the sensor frames that the engines made for a host.
  std::span<const SensorFrame* const> Frames(std::size_t host) const
  {
    return space.GetTick() == 0 ? std::span<const SensorFrame* const>()
                                : std::span<const SensorFrame* const>(frames[host]);
  }

  static SimulatorOptions WithFolder(SimulatorOptions options)
  {
    if (options.output_folder.empty()) options.output_folder = ".";
    return options;
  }

  static RunControlSetup MakeRunControlSetup(const Experiment& experiment, const SimulatorOptions& options)
  {
    RunControlSetup setup{options.paused, options.real_time_factor, options.event_log, {}};
    setup.may_reset = options.may_reset;
    if (!options.events.empty()) setup.repeated = ReadEvents(options.events, experiment);
    return setup;
  }

  const Experiment& experiment;
  const SimulatorOptions options;
  const Assignment assignment;
  const CheckpointOrigin origin = OriginOf(experiment);
  SpaceServer server;
  const CSwarmanoidSpace& space;
  Steering steering;
  std::unique_ptr<WorkerPool> pool;  // shared by the roles, which work one after the other; nullptr for one thread
  ThreadedTicks sharing;
  std::vector<std::unique_ptr<EngineWorker>> engines;
  std::vector<std::unique_ptr<ControllerHost>> hosts;
  std::unique_ptr<StepTimeout> time_budgets;
  std::vector<std::unique_ptr<Visualiser>> visualisers;
  HashLog hash_log;
  // These pointers lead to the messages of a tick. The roles reuse their buffers, so the pointers stay.
  std::vector<std::vector<const SensorFrame*>> frames;  // by host
  std::vector<const ControlCommands*> commands;
  std::vector<std::vector<const ControlCommands*>> commands_of_engines;
  std::vector<const EngineUpdate*> updates;

  std::optional<JournalWriter> journal;
  const SpaceState* journal_state = nullptr;  // of the present tick
  std::vector<SensorFrame> recorded_frames;
  std::vector<ControlCommands> recorded_commands;

  std::uint64_t first_tick = 0;
  std::chrono::steady_clock::time_point start;
  Watch watch;
  bool watching = false;
  bool over = false;
  bool finished = false;
  RunSummary summary;
};

CSimulator::CSimulator(const Experiment& experiment, const SimulatorOptions& options)
    : CSimulator(experiment, options, RunCompanions())
{
}

CSimulator::CSimulator(SpaceServer& server) : server_(&server) {}

CSimulator::CSimulator(const Experiment& experiment, const SimulatorOptions& options, const RunCompanions& companions,
                       unsigned hosts)
{
  RequireReproducibleMath();
  ReportDeaths(program_invocation_short_name);
  std::optional<Checkpoint> restored;
  if (!options.restore_file.empty())
    restored = ReadCheckpoint(options.restore_file, experiment, {hosts, options.any_build});
  roles_ = std::make_unique<Roles>(
      experiment, options,
      restored ? DealRobots(experiment, hosts, restored->snapshot.poses) : DealRobots(experiment, hosts),
      companions.link);
  server_ = &roles_->server;
  roles_->watch = companions.watch;
  CheckCheckpointPeriod(options.checkpoint_every, experiment);
  if (options.checkpoint_every != 0) roles_->TrySavingAll();
  if (restored) roles_->Restore(*restored);
  roles_->first_tick = roles_->space.GetTick();
  roles_->start = std::chrono::steady_clock::now();
  if (!companions.journal_file.empty()) roles_->KeepJournal(companions.journal_file);
  Show();
}

CSimulator::~CSimulator() = default;

void CSimulator::Sense()
{
  RefuseWithin("Sense");
  if (roles_->finished) return;
  for (std::size_t h = 0; h < roles_->hosts.size(); ++h) roles_->hosts[h]->Sense(roles_->Frames(h));
}

bool CSimulator::Step()
{
  RefuseWithin("Step");
  Roles& r = *roles_;
  if (r.over || r.finished) return false;
  r.sharing.Do(r.pool.get(),
               [&]
               {
                 for (std::size_t h = 0; h < r.hosts.size(); ++h) r.hosts[h]->Tick(r.Frames(h));
                 if (r.journal) r.Record(true);
                 for (std::size_t e = 0; e < r.engines.size(); ++e)
                   r.engines[e]->Tick(r.server.Moved(), r.commands_of_engines[e]);
                 r.server.Advance(r.updates, r.commands);
               });
  Show();
  return true;
}

// Shows the state of a tick to the watch function, the hash log and the visualisers. They may end the experiment.
void CSimulator::Show()
{
  Roles& r = *roles_;
  r.steering.WaitForGo(r.visualisers);
  const std::uint64_t tick = r.space.GetTick();
  if (r.options.checkpoint_every != 0 && tick > r.first_tick && tick % r.options.checkpoint_every == 0)
    WriteCheckpoint(r.options.output_folder + "/" + CheckpointName(tick), r.TakeCheckpoint());
  // A run restored from the checkpoint calls the watch function for this tick again.
  if (r.watch)
  {
    r.watching = true;
    RunCodeOf({Actor::kWatcher}, ActivityStep::kWatch, tick, [&] { r.watch(*this); });
    r.watching = false;
  }
  if (r.hash_log.IsOpen()) r.hash_log.Write(r.space.GetTick(), r.space.Hash());
  if (!r.visualisers.empty()) r.server.Draw();
  const Visualiser* terminator = nullptr;
  for (const auto& visualiser : r.visualisers)
    if (visualiser->Draw() && terminator == nullptr) terminator = visualiser.get();
  if (terminator != nullptr && !r.server.IsLast()) r.steering.Stopped(terminator->Id());
  r.over = terminator != nullptr || r.server.IsLast();
  r.summary.interrupted = r.steering.Interrupted();
  if (r.journal) r.journal_state = &r.server.State();
}

bool WatchedSimulator::Describe(const CSimulator& simulator, std::uint32_t robot, RobotStatus& status)
{
  const CSimulator::Roles& r = *simulator.roles_;
  return r.hosts.at(static_cast<std::size_t>(r.assignment.host.at(robot)))->Describe(robot, status);
}

Checkpoint CSimulator::TakeCheckpoint(bool canonicalise)
{
  if (canonicalise)
    for (const auto& engine : roles_->engines) engine->Canonicalise();
  return roles_->TakeCheckpoint();
}

bool CSimulator::IsCanonical() const
{
  const Roles& r = *roles_;
  return r.space.GetTick() % r.experiment.canonical_period == 0 ||
         std::all_of(r.engines.begin(), r.engines.end(),
                     [](const auto& engine) { return engine->Engine().IsAlwaysCanonical(); });
}

void CSimulator::RefuseWithin(const char* function) const
{
  if (!roles_ || roles_->watching)
    throw std::logic_error(fmt::format(
        "{} was called by the function that looks at each tick; the run goes on by itself when that returns",
        function));
}

const RunSummary& CSimulator::Finish()
{
  RefuseWithin("Finish");
  Roles& r = *roles_;
  if (r.finished) return r.summary;
  r.finished = true;
  r.steering.Ended();
  r.summary.reset = r.steering.Reset();
  r.summary.entities = r.space.Size();
  r.summary.ticks = r.space.GetTick();
  r.summary.wall_s = SecondsSince(r.start);
  r.summary.threads = r.pool ? r.pool->Threads() : 1;
  r.summary.shared_ticks = r.sharing.Shared();
  r.summary.real_time_factor =
      RealTimeFactor(r.summary.ticks - r.first_tick, r.experiment.TickSeconds(), r.summary.wall_s);
  if (r.journal)
  {
    r.Record(false);
    r.journal->Flush();
    if (const auto trouble = r.journal->TakeTrouble()) PrintError("the journal ends before the run: {}\n", *trouble);
  }
  r.hash_log.Close();
  r.summary.hash = r.space.Hash();
  r.steering.CloseLink();
  for (const auto& visualiser : r.visualisers) visualiser->Finish();
  for (const auto& host : r.hosts) host->Destroy();
  r.server.Destroy();
  r.summary.failed = r.server.HasFailed();
  r.summary.failure = r.server.Failure();
  return r.summary;
}

const CSwarmanoidSpace& CSimulator::GetSpace() const { return server_->Space(); }

SpaceEditor& CSimulator::GetEditor() { return server_->Editor(); }

const Experiment& CSimulator::GetExperiment() const { return server_->Space().GetExperiment(); }

std::unique_ptr<Experiment> ReadExperiment(const std::string& file,
                                           const std::vector<std::pair<std::string, std::string>>& settings)
{
  RegisterBuiltins();
  LoadOptions options;
  options.settings = settings;
  LoadedExperiment loaded = LoadExperimentFile(file, options);
  if (loaded.experiment) return std::move(loaded.experiment);
  std::string mistakes;
  for (const Diagnostic& error : loaded.errors) mistakes += (mistakes.empty() ? "" : "\n") + error.Text();
  throw ConfigurationError(mistakes);
}

}  // namespace swarmanoid
