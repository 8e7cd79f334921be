// JournalWriter: writes the journal of a run. The thread of the ticks and the main thread of the space server add to
// it; a thread of its own compresses and writes, so that a tick costs a copy. A kill loses what was added within the
// last half of a second, at most.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/journal/journal_format.h"
#include "common/journal/tick_records.h"

namespace swarmanoid
{

class JournalReader;

// A block in the file.
struct JournalPlace
{
  JournalBlockKind kind{};
  std::uint64_t first_tick = 0;
  std::uint32_t ticks = 0;
  std::string name;  // of a part
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

// Takes away what a run that goes on at the tick does again.
void DropFrom(std::vector<JournalPlace>& places, std::uint64_t tick);

class JournalWriter
{
public:
  // Makes the file, with its first block. `beside_launcher`: this process was started by a launcher, which may have
  // given it fewer cores than it has. Throws std::runtime_error with the path.
  JournalWriter(const std::string& path, std::span<const char> start, bool beside_launcher = false);
  // Goes on at `tick` with the journal of a run that has died: keeps what stands there of the ticks before, and what
  // was saved until then. Throws likewise.
  JournalWriter(const JournalReader& journal, std::uint64_t tick, bool beside_launcher = false);
  // Writes all that was added.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  void AddTick(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
               std::span<const ControlCommands> commands);
  void Add(const SpaceSnapshot& snapshot);
  void Add(std::uint64_t tick, const SavedPart& part);

  // Until all that was added is written.
  void Flush();
  // Why nothing is written any more, once: the disk is full. What was written is whole.
  std::optional<std::string> TakeTrouble();
  bool Works() const;
  // All blocks in the file.
  std::vector<JournalPlace> Places() const;
  std::vector<char> Read(const JournalPlace& place) const;
  const std::string& Path() const { return path_; }

private:
  using Clock = std::chrono::steady_clock;

  struct Block
  {
    JournalPlace place;
    TickRows rows;              // of kTicks
    std::vector<char> content;  // of others
  };

  JournalWriter(const std::string& path, int flags);
  void StartThread(bool beside_launcher);
  void Queue(JournalBlockKind kind, std::uint64_t tick, const std::string& name, std::vector<char> content);
  void QueueRows();
  void Write();
  void Write(const Block& block);
  bool Append(std::span<const char> bytes);

  std::string path_;
  int file_ = -1;
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  TickRows rows_;               // being filled
  std::vector<TickRows> free_;  // buffers to fill next
  std::deque<Block> queue_;
  Clock::time_point queued_ = Clock::now();  // the newest tick that is
  std::size_t queued_bytes_ = 0;
  bool writing_ = false;
  bool wanted_ = false;  // rows_ too, however few
  bool over_ = false;
  bool works_ = true;
  std::optional<std::string> trouble_;
  std::vector<JournalPlace> places_;
  std::uint64_t size_ = 0;  // of whole blocks; the writer's thread
  std::thread thread_;
};

}  // namespace swarmanoid
