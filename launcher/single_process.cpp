#include "launcher/single_process.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "common/space/assignment.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "launcher/checkpoint.h"
#include "space_server/space_server.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// One hash a line, from tick 0 on.
class HashLog
{
public:
  explicit HashLog(const std::string& path)
  {
    if (path.empty()) return;
    file_ = std::fopen(path.c_str(), "w");
    if (file_ == nullptr) throw std::runtime_error("cannot write the hash log '" + path + "': " + std::strerror(errno));
  }
  ~HashLog()
  {
    if (file_ != nullptr) std::fclose(file_);
  }
  HashLog(const HashLog&) = delete;
  HashLog& operator=(const HashLog&) = delete;

  void Write(const CSwarmanoidSpace& space)
  {
    if (file_ != nullptr) fmt::print(file_, "{} {:016x}\n", space.GetTick(), space.Hash());
  }

private:
  std::FILE* file_ = nullptr;
};

}  // namespace

RunSummary RunSingleProcess(const Experiment& experiment, const SingleProcessOptions& options)
{
  const Assignment assignment = MakeAssignment(experiment, 1);
  SpaceServer server(experiment, assignment, options.output_folder);
  CSwarmanoidSpace& space = server.Space();

  std::vector<std::unique_ptr<EngineWorker>> engines;
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
    engines.push_back(std::make_unique<EngineWorker>(space, assignment, e));
  ControllerHost host(space, assignment, 0);
  std::vector<std::unique_ptr<Visualiser>> visualisers;
  if (options.visualisations)
    for (const RenderConfiguration& render : experiment.visualisations)
      visualisers.push_back(
          std::make_unique<Visualiser>(render, space, assignment, options.output_folder, nullptr, nullptr));
  HashLog hash_log(options.hash_log);

  // The messages of a tick; the roles reuse their buffers, so these pointers stay.
  std::vector<const SensorFrame*> frames;
  for (const std::uint32_t engine : assignment.hosts[0].frames_from) frames.push_back(&engines[engine]->Sensors());
  std::vector<const EngineUpdate*> updates;
  for (const auto& engine : engines) updates.push_back(&engine->Update());

  if (options.checkpoint_tick % experiment.canonical_period != 0)
    throw std::runtime_error(
        fmt::format("a checkpoint at tick {} is not possible: only every {} ticks (canonical_period)",
                    options.checkpoint_tick, experiment.canonical_period));
  if (!options.restore_file.empty()) LoadCheckpoint(options.restore_file, experiment, space, engines, host);

  RunSummary summary;
  summary.entities = space.Size();
  const Clock::time_point start = Clock::now();
  Clock::time_point reported = start;
  while (true)
  {
    if (options.checkpoint_tick != 0 && space.GetTick() == options.checkpoint_tick)
      SaveCheckpoint(options.checkpoint_file, experiment, space, engines, host);
    hash_log.Write(space);
    bool terminate = false;
    for (const auto& visualiser : visualisers) terminate |= visualiser->Draw();
    if (options.stop != nullptr && *options.stop) summary.interrupted = true;
    if (terminate || summary.interrupted || server.IsLast()) break;

    using Frames = std::span<const SensorFrame* const>;
    using Commands = std::span<const ControlCommands* const>;
    const ControlCommands* commands = &host.Step(space.GetTick() == 0 ? Frames() : Frames(frames));
    for (std::size_t e = 0; e < engines.size(); ++e)
      engines[e]->Step(server.Moved(),
                       assignment.engines[e].commands_from.empty() ? Commands() : Commands(&commands, 1));
    server.Advance(updates, Commands(&commands, 1));

    if (options.real_time_factor > 0)
    {
      const double due = static_cast<double>(space.GetTick()) * experiment.TickSeconds() / options.real_time_factor;
      std::this_thread::sleep_until(start +
                                    std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due)));
    }
    if (options.progress && (space.GetTick() & 15U) == 0 && Clock::now() - reported >= std::chrono::milliseconds(100))
    {
      reported = Clock::now();
      options.progress(space.GetTick());
    }
  }

  summary.ticks = space.GetTick();
  summary.wall_s = SecondsSince(start);
  summary.real_time_factor =
      summary.wall_s > 0 ? static_cast<double>(summary.ticks) * experiment.TickSeconds() / summary.wall_s : 0;
  summary.hash = space.Hash();
  for (const auto& visualiser : visualisers) visualiser->Finish();
  host.Destroy();
  server.Destroy();
  summary.failed = server.HasFailed();
  return summary;
}

std::string FinishedLine(const RunSummary& summary)
{
  return fmt::format("finished: {} ticks, {} entities, hash {:016x}, {:.3f} s, {:.1f}x real time", summary.ticks,
                     summary.entities, summary.hash, summary.wall_s, summary.real_time_factor);
}

}  // namespace swarmanoid
