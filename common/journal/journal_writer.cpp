#include "common/journal/journal_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "common/journal/journal_reader.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::uint32_t kMostTicks = 64;          // of a block
constexpr std::size_t kMostRawBytes = 8U << 20U;  // of a block, before it is compressed
constexpr std::size_t kMostQueued = 256U << 20U;  // then the run waits for the disk
constexpr auto kLatest = 100ms;                   // a tick stays unwritten
constexpr auto kLatestOfFew = 500ms;              // likewise, where ticks are slow: a block of few takes much room
constexpr std::uint32_t kFewTicks = 8;

// The launcher lets the processes of a small run share one core; this thread need not, and goes where that one may.
void UseCoresOfLauncher()
{
  cpu_set_t cores;
  if (sched_getaffinity(getppid(), sizeof cores, &cores) == 0) sched_setaffinity(0, sizeof cores, &cores);
}

}  // namespace

JournalWriter::JournalWriter(const std::string& path, int flags)
    : path_(path), file_(open(path.c_str(), O_RDWR | O_CLOEXEC | flags, 0666))
{
  if (file_ < 0) throw std::runtime_error(fmt::format("cannot make the journal '{}': {}", path, std::strerror(errno)));
}

JournalWriter::JournalWriter(const std::string& path, std::span<const char> start, bool beside_launcher)
    : JournalWriter(path, O_CREAT | O_TRUNC)
{
  Block first;
  first.place.kind = JournalBlockKind::kStart;
  first.content.assign(start.begin(), start.end());
  Write(first);
  StartThread(beside_launcher);
}

JournalWriter::JournalWriter(const JournalReader& journal, std::uint64_t tick, bool beside_launcher)
    : JournalWriter(journal.Path(), 0)
{
  size_ = journal.Bytes();
  if (ftruncate(file_, static_cast<off_t>(size_)) != 0)
    throw std::runtime_error(fmt::format("cannot go on with the journal '{}': {}", path_, std::strerror(errno)));
  Block mark;
  mark.place.kind = JournalBlockKind::kGoOn;
  mark.place.first_tick = tick;
  Block kept;  // of the ticks that share a block with later ones
  kept.place.kind = JournalBlockKind::kTicks;
  for (const JournalPlace& place : journal.Places())
  {
    if (place.kind != JournalBlockKind::kTicks || place.first_tick >= tick || place.first_tick + place.ticks <= tick)
      continue;
    TickRecordReader records(journal.Content(place));
    TickRecord record;
    while (records.Next(record) && record.state.tick < tick)
      kept.rows.Add(record.state, record.save, record.frames, record.commands);
  }
  places_ = journal.Places();
  DropFrom(places_, tick);
  Write(mark);
  kept.place.first_tick = kept.rows.FirstTick();
  kept.place.ticks = kept.rows.Ticks();
  if (!kept.rows.Empty()) Write(kept);
  StartThread(beside_launcher);
}

void JournalWriter::StartThread(bool beside_launcher)
{
  thread_ = std::thread(
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
  Queue(JournalBlockKind::kSnapshot, snapshot.tick, {}, ContentOf(snapshot));
}

void JournalWriter::Add(std::uint64_t tick, const SavedPart& part)
{
  Queue(JournalBlockKind::kPart, tick, part.name, ContentOf(part));
}

void JournalWriter::Queue(JournalBlockKind kind, std::uint64_t tick, const std::string& name, std::vector<char> content)
{
  const std::lock_guard lock(mutex_);
  if (!works_) return;
  queued_bytes_ += content.size();
  Block& block = queue_.emplace_back();
  block.place.kind = kind;
  block.place.first_tick = tick;
  block.place.name = name;
  block.content = std::move(content);
}

void JournalWriter::QueueRows()
{
  if (rows_.Empty()) return;
  queued_ = Clock::now();
  Block& block = queue_.emplace_back();
  block.place.kind = JournalBlockKind::kTicks;
  block.place.first_tick = rows_.FirstTick();
  block.place.ticks = rows_.Ticks();
  queued_bytes_ += rows_.Bytes();
  block.rows = std::move(rows_);
  rows_ = free_.empty() ? TickRows() : std::move(free_.back());
  if (!free_.empty()) free_.pop_back();
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
      // Nobody wakes this thread at a tick, which would cost it more than the copy.
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
    queued_bytes_ -= block.place.kind == JournalBlockKind::kTicks ? block.rows.Bytes() : block.content.size();
    if (block.place.kind == JournalBlockKind::kTicks) free_.push_back(std::move(block.rows));
    changed_.notify_all();
  }
}

void JournalWriter::Write(const Block& block)
{
  if (!Works()) return;
  JournalPlace place = block.place;
  const bool ticks = place.kind == JournalBlockKind::kTicks;
  const std::vector<char> bytes =
      EncodeJournalBlock(place.kind, place.first_tick, place.ticks, ticks ? block.rows.Content() : block.content);
  place.offset = size_;
  place.bytes = bytes.size();
  if (Append(bytes))
  {
    size_ += bytes.size();
    const std::lock_guard lock(mutex_);
    places_.push_back(std::move(place));
    return;
  }
  const int error = errno;
  // What is read ends with a whole block.
  static_cast<void>(!ftruncate(file_, static_cast<off_t>(size_)));
  const std::lock_guard lock(mutex_);
  works_ = false;
  trouble_ = fmt::format("the journal '{}' ends at {} bytes: {}", path_, size_, std::strerror(error));
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

bool JournalWriter::Works() const
{
  const std::lock_guard lock(mutex_);
  return works_;
}

std::vector<JournalPlace> JournalWriter::Places() const
{
  const std::lock_guard lock(mutex_);
  return places_;
}

std::vector<char> JournalWriter::Read(const JournalPlace& place) const
{
  std::vector<char> bytes(place.bytes);
  for (std::size_t at = 0; at < bytes.size();)
  {
    const ssize_t count = pread(file_, bytes.data() + at, bytes.size() - at, static_cast<off_t>(place.offset + at));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      throw std::runtime_error(fmt::format("cannot read the journal '{}' at {}", path_, place.offset + at));
    at += static_cast<std::size_t>(count);
  }
  return bytes;
}

}  // namespace swarmanoid
