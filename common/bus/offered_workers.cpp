#include "common/bus/offered_workers.h"

#include <fmt/format.h>
#include <poll.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "common/activity/limits.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostBytes = 16384;  // of a report, from each descriptor
constexpr std::array<std::pair<std::string_view, WorkerTable>, 2> kPrograms{
    {{"engine_worker", EngineOptionTable}, {"controller_host", HostOptionTable}}};

// False if there is nothing more, now or at all.
bool ReadInto(std::vector<char>& bytes, const FileDescriptor& from)
{
  if (!from.IsOpen() || bytes.size() >= kMostBytes) return false;
  const std::size_t before = bytes.size();
  bytes.resize(kMostBytes);
  const ssize_t count = read(from.Get(), bytes.data() + before, kMostBytes - before);
  bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return count > 0;
}

bool IsReadable(const FileDescriptor& descriptor)
{
  pollfd entry{descriptor.Get(), POLLIN, 0};
  return poll(&entry, 1, 0) > 0;
}

}  // namespace

std::string OfferedWorkers::NameOf(const std::string& program, const WorkerSettings& settings)
{
  if (program != "engine_worker") return fmt::format("controller host {}", settings.host);
  return settings.region ? fmt::format("region {} of engine '{}'", *settings.region, settings.engine)
                         : fmt::format("engine '{}'", settings.engine);
}

void OfferedWorkers::Take(const WorkerRequestMessage& request)
{
  if (request.run != run_ || request.machine != setup_.machine || done_.contains(request.client)) return;
  auto found = workers_.find(request.client);
  if (found == workers_.end())
  {
    if (request.taken != 0) return Refuse(request, "the one who offered it before has gone");
    try
    {
      Worker worker = Start(request);
      // Its successor is here: whoever stood for it has gone.
      for (auto other = workers_.begin(); other != workers_.end();)
        other = other->second.name == worker.name ? Kill(other, "another one takes its place") : std::next(other);
      setup_.say(fmt::format("{} is process {} here", worker.name, worker.process.pid));
      found = workers_.emplace(request.client, std::move(worker)).first;
    }
    catch (const std::exception& error)
    {
      return Refuse(request, error.what());
    }
  }
  Worker& worker = found->second;
  worker.silence.Heard();
  if (request.signal != 0 && std::exchange(worker.signal, request.signal) != request.signal && !worker.end)
    spawner_.Signal(worker.process, request.signal == SIGKILL ? SIGKILL : SIGTERM);
  if (request.taken == worker.report.number) worker.taken = request.taken;
  if (worker.taken == worker.report.number && worker.report.ended)
  {
    done_.insert(request.client);
    workers_.erase(found);
    return;
  }
  MakeReport(worker);
  setup_.report(worker.report);
}

OfferedWorkers::Worker OfferedWorkers::Start(const WorkerRequestMessage& request) const
{
  const auto* program =
      std::ranges::find(kPrograms, std::string_view(request.program), &std::pair<std::string_view, WorkerTable>::first);
  if (program == kPrograms.end())
    throw std::runtime_error(
        fmt::format("{} is not started there; engine_worker and controller_host are", Quoted(request.program)));
  const WorkerSettings settings = SettingsOfWords(program->second, request.words);
  if (settings.experiment != setup_.experiment || settings.machine != setup_.machine || settings.incarnation == 0)
    throw std::runtime_error(
        fmt::format("it must take a place in the run of {} on {}", Quoted(setup_.experiment), Quoted(setup_.machine)));

  ProcessCommand command;
  command.name = NameOf(request.program, settings);
  command.arguments.push_back(std::filesystem::path(setup_.program_folder) / request.program);
  const std::vector<std::string> words = WorkerWords(program->second, settings);
  command.arguments.insert(command.arguments.end(), words.begin(), words.end());
  const std::vector<std::string> bus_words = BusWords(setup_.bus);
  command.arguments.insert(command.arguments.end(), bus_words.begin(), bus_words.end());
  command.environment = EnvironmentOf({request.memory_limit, std::max(request.step_timeout_s, 0.0)});

  Worker worker;
  worker.name = command.name;
  worker.process = spawner_.Start(command);
  worker.report.client = request.client;
  worker.report.run = run_;
  worker.report.process = setup_.process;
  return worker;
}

void OfferedWorkers::Refuse(const WorkerRequestMessage& request, const std::string& why)
{
  setup_.say(fmt::format("refused a worker that {} asks for: {}", request.client, why));
  done_.insert(request.client);
  WorkerReportMessage report;
  report.client = request.client;
  report.run = run_;
  report.process = setup_.process;
  report.number = request.taken + 1;
  report.refusal = why;
  report.ended = true;
  setup_.report(report);
}

// Nothing new as long as the one before is not taken.
void OfferedWorkers::MakeReport(Worker& worker)
{
  if (worker.taken != worker.report.number || worker.report.ended) return;
  if (!worker.end && IsReadable(worker.process.end))
  {
    worker.end = spawner_.Collect(worker.process);
    setup_.say(fmt::format("{} (process {}) {}", worker.name, worker.process.pid, worker.end->Text()));
  }
  WorkerReportMessage next = worker.report;
  next.output.clear();
  next.errors.clear();
  while (ReadInto(next.output, worker.process.output)) continue;
  while (ReadInto(next.errors, worker.process.errors)) continue;
  const bool is_all = next.output.size() < kMostBytes && next.errors.size() < kMostBytes;
  if (worker.end && is_all)
  {
    next.ended = true;
    next.exit_code = static_cast<std::uint32_t>(worker.end->exit_code);
    next.signal = static_cast<std::uint32_t>(worker.end->signal);
    if (worker.process.activity != nullptr) next.activity = BytesOfPage(*worker.process.activity);
  }
  if (next.output.empty() && next.errors.empty() && !next.ended) return;
  ++next.number;
  worker.report = std::move(next);
  setup_.report(worker.report);
}

void OfferedWorkers::Work(Clock::time_point now)
{
  for (auto place = workers_.begin(); place != workers_.end();)
  {
    MakeReport(place->second);
    place = place->second.silence.IsTooLong(now, kSilence)
                ? Kill(place, "the launcher's machine is silent, or wants it no more")
                : std::next(place);
  }
}

OfferedWorkers::Workers::iterator OfferedWorkers::Kill(Workers::iterator place, const std::string& why)
{
  Worker& worker = place->second;
  if (!worker.end)
  {
    spawner_.Signal(worker.process, SIGKILL);
    worker.end = spawner_.Collect(worker.process);
    if (!why.empty()) setup_.say(fmt::format("{} (process {}) is killed: {}", worker.name, worker.process.pid, why));
  }
  done_.insert(place->first);
  return workers_.erase(place);
}

void OfferedWorkers::EndAll()
{
  while (Any()) Kill(workers_.begin(), "");
}

}  // namespace swarmanoid
