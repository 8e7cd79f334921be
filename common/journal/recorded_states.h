// RecordedStates: the space as it was at each tick of a journal. `swarmanoid replay`, `diff`, `export`, `run --branch`,
// and the timeline of the page use it. One thread may use an object.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "common/journal/journal_blocks.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class RecordedStates
{
public:
  // The blocks must outlive this object; they may grow, and lose their oldest. `start` is the state at their begin.
  RecordedStates(const Experiment& experiment, const JournalBlocks& blocks, const JournalStart& start);
  ~RecordedStates();

  // Moves to the next readable tick, at first to the first one. Returns false after the last one. All moves throw
  // std::runtime_error for damaged blocks; then the space is at some other tick.
  bool Next();
  // Moves to that tick; returns false if it cannot be read.
  bool Seek(std::uint64_t tick);
  // Moves to the first readable tick at or after that tick; returns false if none exists.
  bool SeekFrom(std::uint64_t tick);
  // Returns the space at the tick, as the processes saw it that stepped there.
  const CSwarmanoidSpace& Space() const { return *space_; }
  const TickRecord& Record() const { return record_; }

private:
  // Reads the next record. Blocks that end before `wanted` are read without their numbers.
  bool NextRecord(std::uint64_t wanted = 0);
  // Loads the newest whole state at or before the tick.
  void LoadStateBefore(std::uint64_t tick);

  const JournalBlocks& blocks_;
  const JournalStart& start_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  SpaceSnapshot initial_;              // the start of the experiment
  std::optional<std::uint64_t> tick_;  // the tick of the space, if the journal has it
  std::optional<std::uint64_t> next_;  // the first unread tick of the blocks
  std::optional<TickRecordReader> records_;
  TickRecord record_;
};

}  // namespace swarmanoid
