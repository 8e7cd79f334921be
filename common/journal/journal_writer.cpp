// Adding and writing meet in a queue of blocks under mutex_. Ticks gather in rows_ and become a block when they are
// many, old or awaited. The writer's thread takes one block at a time, packs, compresses and appends it, and then
// enters it into the lists.
//
// Invariants: a file ends with a whole block; the first block of a segment names the controller hosts of all its
// blocks; all parts of one saved state are in one segment. DropOldSegments keeps the newest complete state and all
// ticks since then.
#include "common/journal/journal_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/configuration/output_file.h"
#include "common/configuration/regular_file.h"
#include "common/journal/journal_reader.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::uint32_t kMostTicks = 64;          // the largest number of ticks in a block
constexpr std::size_t kMostRawBytes = 8U << 20U;  // the most bytes of a block before compression
constexpr std::size_t kMostQueued = 256U << 20U;  // beyond this, the run waits for the disk
constexpr auto kLatest = 100ms;                   // the longest time until a tick is written
constexpr auto kLatestOfFew = 500ms;  // the same for slow ticks, since a block of few ticks takes much space
constexpr std::uint32_t kFewTicks = 8;
constexpr std::uint64_t kSegments = 8;            // into which a budget is divided
constexpr std::uint64_t kSavedBeforeTelling = 3;  // saved states, before a missing part is reported
constexpr std::size_t kMostPlaces = 4096;         // kept in memory; at least those of the last seconds
constexpr std::size_t kMostSaving = 64;           // states that wait for their parts

// The launcher pins the processes of a small run to one core. This thread may use all cores that the launcher may use.
void UseCoresOfLauncher()
{
  cpu_set_t cores;
  if (sched_getaffinity(getppid(), sizeof cores, &cores) == 0) sched_setaffinity(0, sizeof cores, &cores);
}

}  // namespace

std::string SegmentFile(const std::string& path, std::uint32_t segment)
{
  if (segment == 0) return path;
  return (std::filesystem::path(path).parent_path() / std::to_string(segment)).string();
}

std::vector<std::uint32_t> SegmentsOf(const std::string& path)
{
  namespace fs = std::filesystem;
  std::set<std::uint32_t> numbers;
  std::error_code none;
  if (fs::exists(path, none)) numbers.insert(0);
  const fs::path parent = fs::path(path).parent_path();
  for (const fs::directory_entry& entry : fs::directory_iterator(parent.empty() ? "." : parent, none))
  {
    const std::string name = entry.path().filename().string();
    std::uint32_t number = 0;
    const auto read = std::from_chars(name.data(), name.data() + name.size(), number);
    if (read.ec == std::errc() && number > 0 && name == std::to_string(number)) numbers.insert(number);
  }
  return {numbers.begin(), numbers.end()};
}

JournalWriter::JournalWriter(const std::string& path, std::uint32_t segment, int flags, JournalBudget budget)
    : path_(path),
      budget_(std::move(budget)),
      file_(OpenOutput(SegmentFile(path, segment), O_RDWR | flags)),
      segment_(segment)
{
  if (file_ < 0)
    throw std::runtime_error(
        fmt::format("cannot make the journal '{}': {}", SegmentFile(path, segment), std::strerror(errno)));
}

JournalWriter::JournalWriter(const std::string& path, std::span<const char> start, bool beside_launcher,
                             JournalBudget budget)
    : JournalWriter(path, 0, O_CREAT | O_TRUNC, std::move(budget))
{
  // An earlier run in the same folder may have left segments.
  for (const std::uint32_t later : SegmentsOf(path_))
    if (later > 0) std::filesystem::remove(SegmentFile(path_, later));
  start_.assign(start.begin(), start.end());
  open_start_ = start_;
  tables_.push_back(Start().hosts);
  Block first;
  first.place.kind = JournalBlockKind::kStart;
  first.content = start_;
  Write(first);
  StartThread(beside_launcher);
}

JournalWriter::JournalWriter(const JournalReader& journal, std::uint64_t tick, bool beside_launcher,
                             JournalBudget budget)
    : JournalWriter(journal.Path(), journal.NewestSegment(), 0, std::move(budget))
{
  JournalStart start = journal.Start();
  tables_ = journal.Tables();
  start.hosts = tables_.back();
  start_ = ContentOf(start);
  open_start_ = start_;
  size_ = journal.NewestSegmentBytes();
  all_bytes_ = journal.Bytes();
  // Removes segments whose first block was incomplete when the run died, or that follow a damaged one.
  for (const std::uint32_t later : SegmentsOf(path_))
    if (later > segment_) std::filesystem::remove(SegmentFile(path_, later));
  if (ftruncate(file_, static_cast<off_t>(size_)) != 0)
    throw std::runtime_error(fmt::format("cannot go on with the journal '{}': {}", path_, std::strerror(errno)));
  Block mark;
  mark.place.kind = JournalBlockKind::kGoOn;
  mark.place.first_tick = tick;
  std::vector<JournalPlace> before = journal.Places();
  AddPlace(before, mark.place);
  before.pop_back();
  for (const JournalPlace& place : before) Note(place);
  Write(mark);
  StartThread(beside_launcher);
}

void JournalWriter::StartThread(bool beside_launcher)
{
  thread_ = RunThread("writes the journal",
                      [this, beside_launcher]
                      {
                        if (beside_launcher) UseCoresOfLauncher();
                        Write();
                      });
}

JournalWriter::~JournalWriter()
{
  {
    const std::lock_guard lock(mutex_);
    QueueRows();
    over_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  close(file_);
}

void JournalWriter::AddTick(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
                            std::span<const ControlCommands> commands)
{
  std::unique_lock lock(mutex_);
  if (!works_) return;
  if (!rows_.Add(state, save, frames, commands))
  {
    QueueRows();
    rows_.Add(state, save, frames, commands);
  }
  if (rows_.Ticks() < kMostTicks && rows_.Bytes() < kMostRawBytes) return;
  changed_.wait(lock, [this] { return queued_bytes_ < kMostQueued || !works_; });
  QueueRows();
}

void JournalWriter::Add(const SpaceSnapshot& snapshot)
{
  std::vector<char> content = ContentOf(snapshot);
  const std::lock_guard lock(mutex_);
  Queue(JournalBlockKind::kSnapshot, snapshot.tick, {}, std::move(content));
}

void JournalWriter::Add(std::uint64_t tick, const SavedPart& part)
{
  std::vector<char> content = ContentOf(part);
  const std::lock_guard lock(mutex_);
  Queue(JournalBlockKind::kPart, tick, part.name, std::move(content));
}

void JournalWriter::Queue(JournalBlockKind kind, std::uint64_t tick, const std::string& name, std::vector<char> content)
{
  if (!works_) return;
  // All parts of a saved state go into one segment; parts may arrive before the space.
  const bool may_open_segment = budget_.bytes != 0 && tick > saved_;
  saved_ = std::max(saved_, tick);
  if (may_open_segment) QueueRows();
  Block& block = queue_.emplace_back();
  block.queued = content.size();
  queued_bytes_ += block.queued;
  block.place.kind = kind;
  block.place.first_tick = tick;
  block.place.name = name;
  block.content = std::move(content);
  block.may_open_segment = may_open_segment;
}

void JournalWriter::BeginHosts(const HostTable& hosts, std::uint64_t tick)
{
  const std::lock_guard lock(mutex_);
  if (!works_) return;
  QueueRows();
  JournalStart start = ReadStart(start_);
  start.hosts = hosts;
  start_ = ContentOf(start);
  Block& block = queue_.emplace_back();
  block.place.kind = JournalBlockKind::kGoOn;
  block.place.first_tick = tick;
  block.start = start_;
}

JournalStart JournalWriter::Start() const
{
  const std::lock_guard lock(mutex_);
  return ReadStart(start_);
}

HostTable JournalWriter::Table(std::uint32_t number) const
{
  const std::lock_guard lock(mutex_);
  if (number >= tables_.size())
    throw std::runtime_error(
        fmt::format("the journal '{}' does not say which controller hosts had the robots: it is damaged", path_));
  return tables_[number];
}

void JournalWriter::QueueRows()
{
  if (rows_.Empty()) return;
  queued_ = Clock::now();
  Block& block = queue_.emplace_back();
  block.place.kind = JournalBlockKind::kTicks;
  block.place.first_tick = rows_.FirstTick();
  block.place.ticks = rows_.Ticks();
  block.queued = rows_.Bytes();
  queued_bytes_ += block.queued;
  block.rows = std::move(rows_);
  rows_ = free_.empty() ? TickRows() : std::move(free_.back());
  if (!free_.empty()) free_.pop_back();
  block.rows.Finish(rows_);
  rows_.Clear();
}

void JournalWriter::Write()
{
  std::unique_lock lock(mutex_);
  while (true)
  {
    if (queue_.empty())
    {
      if (over_) return;
      // The writer's thread wakes by time, since waking it at each tick would cost the ticks' thread more than the
      // copy.
      changed_.wait_for(lock, kLatest, [this] { return wanted_ || over_; });
      const bool early = rows_.Ticks() < kFewTicks && Clock::now() - queued_ < kLatestOfFew;
      if (!early || wanted_ || over_) QueueRows();
      wanted_ = false;
      if (queue_.empty()) changed_.notify_all();
      continue;
    }
    Block block = std::move(queue_.front());
    queue_.pop_front();
    writing_ = true;
    lock.unlock();
    Write(block);
    lock.lock();
    writing_ = false;
    queued_bytes_ -= block.queued;
    if (block.place.kind == JournalBlockKind::kTicks) free_.push_back(std::move(block.rows));
    changed_.notify_all();
  }
}

void JournalWriter::Write(Block& block)
{
  // The writer's thread decides, since the bytes of blocks that still wait in the queue are not known before.
  if (!block.start.empty())
    OpenNextSegment(std::move(block.start), block.place.first_tick);
  else if (block.may_open_segment && size_ >= budget_.bytes / kSegments)
    OpenNextSegment(open_start_, block.place.first_tick);
  WriteBlock(block);
  if (budget_.bytes != 0 && block.place.kind == JournalBlockKind::kPart) DropOldSegments();
}

// The previous segment is complete. If the next one cannot be made, the journal ends there.
void JournalWriter::OpenNextSegment(std::vector<char> start, std::uint64_t tick)
{
  if (!Works()) return;
  const int next = OpenOutput(SegmentFile(path_, segment_ + 1), O_RDWR | O_CREAT | O_TRUNC);
  if (next < 0)
  {
    const std::string error = std::strerror(errno);
    const std::lock_guard lock(mutex_);
    works_ = false;
    trouble_ = fmt::format("the journal '{}' cannot be made: {}", SegmentFile(path_, segment_ + 1), error);
    return;
  }
  close(file_);
  file_ = next;
  ++segment_;
  size_ = 0;
  Block first;
  first.place.kind = JournalBlockKind::kStart;
  first.place.first_tick = tick;
  first.content = start;
  open_start_ = std::move(start);
  {
    const std::lock_guard lock(mutex_);
    if (HostTable hosts = ReadStart(open_start_).hosts; hosts != tables_.back()) tables_.push_back(std::move(hosts));
  }
  WriteBlock(first);
}

void JournalWriter::Note(const JournalPlace& place)
{
  if (segments_.empty() || segments_.back().number != place.segment) segments_.emplace_back().number = place.segment;
  Segment& segment = segments_.back();
  if (place.kind == JournalBlockKind::kTicks)
    segment.ticks_end = std::max(segment.ticks_end, place.first_tick + place.ticks);
  if (place.kind == JournalBlockKind::kSnapshot)
  {
    ++segment.states;
    NoteSaved(place.first_tick,
              [&](SavedState& state)
              {
                state.has_space = true;
                state.segment = std::min(state.segment, place.segment);
              });
  }
  if (place.kind == JournalBlockKind::kPart)
  {
    segment.parts.insert(place.name);
    NoteSaved(place.first_tick,
              [&](SavedState& state)
              {
                state.parts.insert(place.name);
                state.segment = std::min(state.segment, place.segment);
              });
  }
  AddPlace(places_, place);
  if (places_.size() < kMostPlaces) return;
  places_.erase(places_.begin(), places_.begin() + kMostPlaces / 2);
  has_forgotten_ = true;
}

void JournalWriter::NoteSaved(std::uint64_t tick, const std::function<void(SavedState&)>& add)
{
  SavedState& state = saving_[tick];
  add(state);
  const bool is_complete = state.has_space && std::ranges::all_of(budget_.parts, [&](const std::string& name)
                                                                  { return state.parts.contains(name); });
  if (is_complete)
  {
    complete_ = tick;
    complete_segment_ = state.segment;
    saving_.erase(saving_.begin(), saving_.upper_bound(tick));
  }
  while (saving_.size() > kMostSaving) saving_.erase(saving_.begin());
}

std::string JournalWriter::LackingPart() const
{
  for (const std::string& name : budget_.parts)
    if (std::ranges::none_of(segments_, [&](const Segment& segment) { return segment.parts.contains(name); }))
      return name;
  return {};
}

// Deletes the segments before the newest state that all processes saved, if no later tick is in them.
void JournalWriter::DropOldSegments()
{
  const std::lock_guard lock(mutex_);
  while (all_bytes_ > budget_.bytes && !segments_.empty())
  {
    const Segment& oldest = segments_.front();
    if (!complete_ || complete_segment_ <= oldest.number || oldest.ticks_end > *complete_) return;
    std::error_code none;
    const std::uint64_t bytes = std::filesystem::file_size(SegmentFile(path_, oldest.number), none);
    if (none || !std::filesystem::remove(SegmentFile(path_, oldest.number), none)) return;
    all_bytes_ -= std::min(all_bytes_, bytes);
    std::erase_if(places_, [&](const JournalPlace& place) { return place.segment == oldest.number; });
    segments_.erase(segments_.begin());
  }
}

void JournalWriter::WriteBlock(Block& block)
{
  if (!Works()) return;
  JournalPlace place = block.place;
  place.segment = segment_;
  const bool ticks = place.kind == JournalBlockKind::kTicks;
  const std::span<const char> bytes =
      EncodeJournalBlock(place.kind, place.first_tick, place.ticks,
                         ticks ? block.rows.Content(room_) : std::span<const char>(block.content));
  place.offset = size_;
  place.bytes = bytes.size();
  if (Append(bytes))
  {
    size_ += bytes.size();
    const std::lock_guard lock(mutex_);
    all_bytes_ += bytes.size();
    place.table = static_cast<std::uint32_t>(tables_.size() - 1);
    Note(place);
    return;
  }
  const int error = errno;
  // The file is cut to its last whole block, so that readers find only whole blocks.
  static_cast<void>(!ftruncate(file_, static_cast<off_t>(size_)));
  const std::lock_guard lock(mutex_);
  works_ = false;
  trouble_ =
      fmt::format("the journal '{}' ends at {} bytes: {}", SegmentFile(path_, segment_), size_, std::strerror(error));
}

bool JournalWriter::Append(std::span<const char> bytes)
{
  std::uint64_t at = size_;
  while (!bytes.empty())
  {
    const ssize_t count = pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += static_cast<std::uint64_t>(count);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

void JournalWriter::Flush()
{
  std::unique_lock lock(mutex_);
  QueueRows();
  wanted_ = true;
  changed_.notify_all();
  changed_.wait(lock, [this] { return queue_.empty() && !writing_; });
}

std::optional<std::string> JournalWriter::TakeTrouble()
{
  const std::lock_guard lock(mutex_);
  return std::exchange(trouble_, std::nullopt);
}

std::optional<std::string> JournalWriter::TakeExcess()
{
  const std::lock_guard lock(mutex_);
  if (budget_.bytes == 0 || excess_told_ || all_bytes_ <= 2 * budget_.bytes) return std::nullopt;
  std::uint64_t states = 0;
  for (const Segment& segment : segments_) states += segment.states;
  if (states < kSavedBeforeTelling) return std::nullopt;
  const std::string lacking = LackingPart();
  if (lacking.empty()) return std::nullopt;
  excess_told_ = true;
  return fmt::format(
      "the journal '{}' has {} bytes, more than its budget, and keeps all: without its start {} could not be replaced, "
      "since it saves no state (controllers and experiment functions need HasState, SaveState and LoadState)",
      path_, all_bytes_, lacking);
}

std::uint64_t JournalWriter::Bytes() const
{
  const std::lock_guard lock(mutex_);
  return all_bytes_;
}

bool JournalWriter::Works() const
{
  const std::lock_guard lock(mutex_);
  return works_;
}

std::vector<JournalPlace> JournalWriter::RecentPlaces() const
{
  const std::lock_guard lock(mutex_);
  return places_;
}

std::vector<JournalPlace> JournalWriter::Places() const
{
  {
    const std::lock_guard lock(mutex_);
    if (!has_forgotten_) return places_;
  }
  const JournalReader reader(path_);
  std::vector<JournalPlace> places = reader.Places();
  const std::lock_guard lock(mutex_);
  // The oldest tables may belong to deleted segments.
  const auto older = static_cast<std::uint32_t>(tables_.size() - std::min(tables_.size(), reader.Tables().size()));
  for (JournalPlace& place : places)
    if (place.table != kUnknownTable) place.table += older;
  return places;
}

std::vector<char> JournalWriter::Read(const JournalPlace& place) const
{
  const std::string path = SegmentFile(path_, place.segment);
  std::vector<char> bytes = RegularFile(path).Read(place.offset, place.bytes);
  if (bytes.size() != place.bytes)
    throw std::runtime_error(fmt::format("cannot read the journal '{}' at byte {}: another program made it shorter",
                                         path, place.offset + bytes.size()));
  return bytes;
}

}  // namespace swarmanoid
