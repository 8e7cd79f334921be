// JournalWriter: writes the journal of a run. The thread of the ticks and the main thread of the space server add to
// it; a thread of its own compresses and writes, so that a tick costs a copy. A kill loses what was added within the
// last half of a second, at most. With a budget it is written in segments, and the oldest are deleted.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/journal/journal_format.h"
#include "common/journal/tick_records.h"
#include "common/threads/waiting.h"

namespace swarmanoid
{

class JournalReader;

// A block in a file.
struct JournalPlace
{
  JournalBlockKind kind{};
  std::uint64_t first_tick = 0;
  std::uint32_t ticks = 0;  // the valid ones; the run may have repeated later ones of the block
  std::string name;         // of a part
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::uint32_t segment = 0;
  std::uint32_t table = 0;  // of the controller hosts then: its number among the tables of the journal
};
// The table of blocks in a segment whose first block, which has the table, is damaged.
inline constexpr std::uint32_t kUnknownTable = UINT32_MAX;

// How much of a journal is kept.
struct JournalBudget
{
  std::uint64_t bytes = 0;         // 0: everything
  std::vector<std::string> parts;  // of the processes without whose state nobody goes on
};

// The file of a segment. `path`: of the first one; the others lie beside it, named by their numbers.
std::string SegmentFile(const std::string& path, std::uint32_t segment);
// Returns the numbers of the segments that exist, the oldest first.
std::vector<std::uint32_t> SegmentsOf(const std::string& path);

// Adds a block that was written after the others. It removes the blocks that the new one replaces: ticks after the one
// where the run goes on, and ticks that the new block contains again.
void AddPlace(std::vector<JournalPlace>& places, JournalPlace place);

class JournalWriter
{
public:
  // Makes the file, with its first block. `beside_launcher`: this process was started by a launcher, which may have
  // given it fewer cores than it has. Throws std::runtime_error with the path.
  JournalWriter(const std::string& path, std::span<const char> start, bool beside_launcher = false,
                JournalBudget budget = {});
  // Goes on at `tick` with the journal of a run that has died: keeps what stands there of the ticks before, and what
  // was saved until then. Throws likewise.
  JournalWriter(const JournalReader& journal, std::uint64_t tick, bool beside_launcher = false,
                JournalBudget budget = {});
  // Writes all that was added.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  void AddTick(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
               std::span<const ControlCommands> commands);
  void Add(const SpaceSnapshot& snapshot);
  void Add(std::uint64_t tick, const SavedPart& part);
  // The robots are shared out among controller hosts anew at the tick: what is added from now on is of these.
  void BeginHosts(const HostTable& hosts, std::uint64_t tick);

  // Until all that was added is written.
  void Flush();
  // Why nothing is written any more, once: the disk is full. What was written is whole.
  std::optional<std::string> TakeTrouble();
  // Why the journal is longer than its budget, once: nobody could go on without what is oldest.
  std::optional<std::string> TakeExcess();
  bool Works() const;
  // Bytes of all segments.
  std::uint64_t Bytes() const;
  // The newest blocks that were written. Their number has a limit, however long the run.
  std::vector<JournalPlace> RecentPlaces() const;
  // All blocks that are kept. If these are more, the files are read again.
  std::vector<JournalPlace> Places() const;
  std::vector<char> Read(const JournalPlace& place) const;
  const std::string& Path() const { return path_; }
  JournalStart Start() const;
  // By the number that places have.
  HostTable Table(std::uint32_t number) const;

private:
  using Clock = RunClock;

  struct Block
  {
    JournalPlace place{};
    TickRows rows{};              // of kTicks
    std::vector<char> content{};  // of others
    std::size_t queued = 0;       // its bytes as they count in queued_bytes_
    std::vector<char> start{};    // of the next segment, if it is the first one of that
  };

  // A segment that is kept.
  struct Segment
  {
    std::uint32_t number = 0;
    std::uint64_t ticks_end = 0;  // the tick after the newest one
    std::uint64_t states = 0;     // of the space
    std::set<std::string> parts;  // names
  };
  // The parts of a tick's state that processes have saved.
  struct SavedState
  {
    bool has_space = false;
    std::set<std::string> parts;
    std::uint32_t segment = UINT32_MAX;  // the oldest one that has some of it
  };

  JournalWriter(const std::string& path, std::uint32_t segment, int flags, JournalBudget budget);
  // Takes a block that stands in the file into account. With the mutex.
  void Note(const JournalPlace& place);
  void NoteSaved(std::uint64_t tick, const std::function<void(SavedState&)>& add);
  void StartThread(bool beside_launcher);
  void Queue(JournalBlockKind kind, std::uint64_t tick, const std::string& name, std::vector<char> content);
  void QueueRows();
  void Write();
  void Write(Block& block);
  void WriteBlock(Block& block);
  void OpenNextSegment(const Block& opening);
  void DropOldSegments();
  // The first of the parts that is in no saved state, while the budget is exceeded.
  std::string LackingPart() const;
  bool Append(std::span<const char> bytes);

  std::string path_;
  JournalBudget budget_;
  std::vector<char> start_;  // the content of the first block of the segment that is added to
  int file_ = -1;            // the newest segment
  std::uint32_t segment_ = 0;
  ReusedMemory room_;         // the content of a block; only the writer's thread uses it
  mutable std::mutex mutex_;  // of what follows
  RunCondition changed_;
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
  bool excess_told_ = false;
  std::vector<JournalPlace> places_;  // the newest; older ones are forgotten
  bool has_forgotten_ = false;
  std::vector<Segment> segments_;               // the newest one last
  std::map<std::uint64_t, SavedState> saving_;  // by tick: states that are not complete yet
  std::optional<std::uint64_t> complete_;       // the newest tick of which all parts are there
  std::uint32_t complete_segment_ = 0;          // the oldest one that has some of that state
  std::vector<HostTable> tables_;               // the last one is that of the newest segment
  std::uint64_t saved_ = 0;                     // the newest tick of which some state was added
  std::uint64_t all_bytes_ = 0;                 // of whole blocks in all segments
  std::uint64_t segment_from_ = 0;              // all_bytes_ when the newest segment was begun, or is to be
  std::uint64_t size_ = 0;                      // of whole blocks of the newest segment; the writer's thread
  RunThread thread_;
};

}  // namespace swarmanoid
