// JournalWriter: writes the journal of a run. The thread of the ticks and the main thread of the space server add to
// it. A separate thread compresses and writes, so that a tick only pays for a copy. A kill loses at most the blocks of
// the last half second. With a budget the journal is written in segments, and the oldest are deleted.
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

// It tells where a block is in the files, and what it holds.
struct JournalPlace
{
  JournalBlockKind kind{};
  std::uint64_t first_tick = 0;
  std::uint32_t ticks = 0;  // the valid ticks; the run may have repeated later ones of the block
  std::string name;         // the name, for a part
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::uint32_t segment = 0;
  std::uint32_t table = 0;  // the number of the table of controller hosts among the tables of the journal
};
// The number of the table for blocks whose segment has a damaged first block, which holds the table.
inline constexpr std::uint32_t kUnknownTable = UINT32_MAX;

// A journal may take this much room on the disk.
struct JournalBudget
{
  std::uint64_t bytes = 0;         // 0: everything
  std::vector<std::string> parts;  // the processes whose states are needed to continue the run
};

// Returns the file of a segment. `path`: the first one; the others lie beside it, named by their numbers.
std::string SegmentFile(const std::string& path, std::uint32_t segment);
// Returns the numbers of the segments that exist, the oldest first.
std::vector<std::uint32_t> SegmentsOf(const std::string& path);

// Adds a block that was written after the others. It removes the blocks that the new one replaces: ticks after the one
// where the run continues, and ticks that the new block contains again.
void AddPlace(std::vector<JournalPlace>& places, JournalPlace place);

class JournalWriter
{
public:
  // Makes the file with its first block. `beside_launcher`: a launcher started this process and may have given it fewer
  // cores than its own. Throws std::runtime_error with the path.
  JournalWriter(const std::string& path, std::span<const char> start, bool beside_launcher = false,
                JournalBudget budget = {});
  // Continues the journal of a run that has died at `tick`. It keeps the earlier ticks and the states saved until then.
  // Throws as above.
  JournalWriter(const JournalReader& journal, std::uint64_t tick, bool beside_launcher = false,
                JournalBudget budget = {});
  // Writes all added blocks.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  void AddTick(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
               std::span<const ControlCommands> commands);
  // Add the saved state of the space, and of another process, at a tick.
  void Add(const SpaceSnapshot& snapshot);
  void Add(std::uint64_t tick, const SavedPart& part);
  // Starts a new table of controller hosts at the tick, when robots are assigned to other hosts. Later blocks belong to
  // it.
  void BeginHosts(const HostTable& hosts, std::uint64_t tick);

  // Waits until all added blocks are written.
  void Flush();
  // Returns, once, why nothing is written any more, such as a full disk. The written blocks stay whole.
  std::optional<std::string> TakeTrouble();
  // Returns, once, why the journal is longer than its budget: the oldest blocks are needed to continue the run.
  std::optional<std::string> TakeExcess();
  bool Works() const;
  // Returns the bytes of all segments.
  std::uint64_t Bytes() const;
  // Returns the newest written blocks. Their number has a limit.
  std::vector<JournalPlace> RecentPlaces() const;
  // Returns all blocks that are kept. If memory does not hold them all, the files are read again.
  std::vector<JournalPlace> Places() const;
  std::vector<char> Read(const JournalPlace& place) const;
  const std::string& Path() const { return path_; }
  JournalStart Start() const;
  // Returns the table with that number (JournalPlace::table).
  HostTable Table(std::uint32_t number) const;

private:
  using Clock = RunClock;

  struct Block
  {
    JournalPlace place{};
    TickRows rows{};              // for kTicks
    std::vector<char> content{};  // for other kinds
    std::size_t queued = 0;       // the bytes that it adds to queued_bytes_
    std::vector<char> start{};    // the start of the next segment, if this block opens it
    // It is the first of a saved state: it opens a segment if the open one is long enough.
    bool may_open_segment = false;
  };

  // A segment that is kept.
  struct Segment
  {
    std::uint32_t number = 0;
    std::uint64_t ticks_end = 0;  // the tick after its newest tick
    std::uint64_t states = 0;     // the number of saved spaces
    std::set<std::string> parts;  // the names of the saved parts
  };
  // The parts of a tick's state that processes have saved.
  struct SavedState
  {
    bool has_space = false;
    std::set<std::string> parts;
    std::uint32_t segment = UINT32_MAX;  // the oldest segment with a part of the state
  };

  JournalWriter(const std::string& path, std::uint32_t segment, int flags, JournalBudget budget);
  // Adds a block of the file to the lists. The caller holds mutex_.
  void Note(const JournalPlace& place);
  void NoteSaved(std::uint64_t tick, const std::function<void(SavedState&)>& add);
  void StartThread(bool beside_launcher);
  void Queue(JournalBlockKind kind, std::uint64_t tick, const std::string& name, std::vector<char> content);
  void QueueRows();
  void Write();
  void Write(Block& block);
  void WriteBlock(Block& block);
  void OpenNextSegment(std::vector<char> start, std::uint64_t tick);
  void DropOldSegments();
  // While the budget is exceeded, returns the first of the parts that no saved state has.
  std::string LackingPart() const;
  bool Append(std::span<const char> bytes);

  std::string path_;
  JournalBudget budget_;
  std::vector<char> start_;       // the content of the first block of the newest segment that is queued
  std::vector<char> open_start_;  // the same of the open segment; only the writer's thread uses it
  int file_ = -1;                 // the newest segment
  std::uint32_t segment_ = 0;
  ReusedMemory room_;         // the content of a block; only the writer's thread uses it
  mutable std::mutex mutex_;  // guards the members below
  RunCondition changed_;
  TickRows rows_;               // the buffer that is being filled
  std::vector<TickRows> free_;  // buffers to fill next
  std::deque<Block> queue_;
  Clock::time_point queued_ = Clock::now();  // when the newest queued tick was added
  std::size_t queued_bytes_ = 0;
  bool writing_ = false;
  bool wanted_ = false;  // rows_ is to be written, too, even if it has few ticks
  bool over_ = false;
  bool works_ = true;
  std::optional<std::string> trouble_;
  bool excess_told_ = false;
  std::vector<JournalPlace> places_;  // the newest blocks; older ones are dropped
  bool has_forgotten_ = false;
  std::vector<Segment> segments_;               // the newest segment is last
  std::map<std::uint64_t, SavedState> saving_;  // by tick: incomplete states
  std::optional<std::uint64_t> complete_;       // the newest tick whose state is complete
  std::uint32_t complete_segment_ = 0;          // the oldest segment with a part of that state
  std::vector<HostTable> tables_;               // the last table is that of the newest segment
  std::uint64_t saved_ = 0;                     // the newest tick with an added state
  std::uint64_t all_bytes_ = 0;                 // bytes of whole blocks in all segments
  std::uint64_t size_ = 0;  // bytes of whole blocks of the newest segment; only the writer's thread uses it
  RunThread thread_;
};

}  // namespace swarmanoid
