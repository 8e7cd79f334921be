// A thread waits for requests and for news of the journal. It takes all requests at once, follows the journal, and
// answers them one after the other, in the order of clients. `mutex_` guards the requests and is free while the thread
// reads.
#include "visualiser/playback_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "common/configuration/regular_file.h"
#include "common/journal/journal_reader.h"
#include "common/program/csv.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kMostEventBytes = std::uint64_t{16} << 20U;

// Returns the events in the complete lines of a run's event log.
std::vector<TimelineEvent> EventsOf(const std::string& text)
{
  std::vector<TimelineEvent> events;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line) && !lines.eof(); ++number)
  {
    const std::vector<std::string> fields = CsvFields(line);
    TimelineEvent event;
    if (number == 1 && line.starts_with("tick,")) continue;
    const auto read = fields.empty()
                          ? std::from_chars_result{nullptr, std::errc::invalid_argument}
                          : std::from_chars(fields[0].data(), fields[0].data() + fields[0].size(), event.tick);
    if (fields.size() < 3 || read.ec != std::errc())
    {
      events.push_back(
          {events.empty() ? 0 : events.back().tick, fmt::format("line {} of events.csv is damaged", number), {}, {}});
      continue;
    }
    event.what = fields[1];
    event.entity = fields[2];
    if (fields.size() > 4) event.from = fields[4];
    events.push_back(std::move(event));
  }
  return events;
}

}  // namespace

std::vector<TimelineEvent> TimelineEventsOf(const std::string& run_folder)
{
  const std::string file = run_folder + "/events.csv";
  if (run_folder.empty() || !std::filesystem::exists(file)) return {};
  return EventsOf(ReadRegularFile(file, kMostEventBytes));
}

PlaybackReader::PlaybackReader(const Experiment& experiment, std::string run_folder, LookBackAnswers answers)
    : experiment_(experiment),
      run_folder_(std::move(run_folder)),
      answers_(std::move(answers)),
      journal_(JournalFile(run_folder_)),
      thread_([this] { Work(); })
{
}

PlaybackReader::~PlaybackReader()
{
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void PlaybackReader::Ask(std::uint64_t client, const LookBackRequest& request)
{
  const std::lock_guard lock(mutex_);
  wanted_[client] = request;
  changed_.notify_all();
}

void PlaybackReader::Forget(std::uint64_t client)
{
  const std::lock_guard lock(mutex_);
  wanted_.erase(client);
}

void PlaybackReader::Refresh()
{
  const std::lock_guard lock(mutex_);
  refresh_ = true;
  changed_.notify_all();
}

void PlaybackReader::Work()
{
  std::unique_lock lock(mutex_);
  while (true)
  {
    changed_.wait(lock, [this] { return over_ || refresh_ || !wanted_.empty(); });
    if (over_) return;
    const bool refresh = std::exchange(refresh_, false);
    const std::map<std::uint64_t, LookBackRequest> wanted = std::exchange(wanted_, {});
    lock.unlock();
    try
    {
      // Segments that were read may have been deleted since.
      if (refresh || !wanted.empty()) Follow();
    }
    catch (const std::exception&)
    {
      // The journal may be half written or gone, so the next call tries again.
    }
    for (const auto& [client, request] : wanted) Answer(client, request);
    lock.lock();
  }
}

bool PlaybackReader::IsOpen()
{
  if (states_ || refused_) return !refused_;
  journal_.Refresh();
  if (!journal_.IsBegun()) return false;
  refused_ = journal_.Start().origin.experiment != FingerprintOf(experiment_);
  if (refused_) return false;
  states_ = std::make_unique<RecordedStates>(experiment_, journal_, journal_.Start());
  return true;
}

void PlaybackReader::Follow()
{
  if (!IsOpen()) return;
  journal_.Refresh();
  JournalTimeline now{journal_.FirstTick(), journal_.EndTick(), timeline_.events};
  const std::string file = run_folder_ + "/events.csv";
  std::error_code none;
  const std::uint64_t bytes = std::filesystem::file_size(file, none);
  if (!none && bytes != events_bytes_)
  {
    events_bytes_ = bytes;
    now.events = TimelineEventsOf(run_folder_);
  }
  if (now == timeline_) return;
  timeline_ = std::move(now);
  answers_.timeline(timeline_);
}

void PlaybackReader::Answer(std::uint64_t client, LookBackRequest request)
{
  try
  {
    if (!IsOpen()) throw std::runtime_error("the run keeps no journal here");
    if (!states_->Seek(request.tick))
      throw std::runtime_error(fmt::format("the journal has ticks {} to {}, and not {}", journal_.FirstTick(),
                                           journal_.EndTick() - 1, request.tick));
    const CSwarmanoidSpace& space = states_->Space();
    std::erase_if(request.entities, [&](std::uint32_t entity) { return entity >= space.Size(); });
    answers_.past(client, request, space);
  }
  catch (const std::exception& error)
  {
    answers_.refused(client, fmt::format("nothing can be shown of tick {}: {}", request.tick, error.what()));
  }
}

std::string RunFolderOf(const std::string& output_folder, RunMonitor* monitor)
{
  const bool of_run =
      !output_folder.empty() && std::filesystem::exists(std::filesystem::path(output_folder) / "manifest.json");
  if (of_run) return std::filesystem::absolute(output_folder).lexically_normal().string();
  return monitor == nullptr ? std::string() : monitor->RunFolder();
}

}  // namespace swarmanoid
