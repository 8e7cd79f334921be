// RecordedStates: the space as it was at each tick that a journal has. Used by what looks back: `swarmanoid replay`,
// `diff`, `export`, `run --branch`, and the timeline of the page. One thread.
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
  // The blocks outlive this; they may grow, and lose their oldest. `start` is what they begin with.
  RecordedStates(const Experiment& experiment, const JournalBlocks& blocks, const JournalStart& start);
  ~RecordedStates();

  // To the next tick that can be read, at first to the first one; false after the last one. Throws std::runtime_error
  // for what is damaged, as the others do; then the space is at some other tick.
  bool Next();
  // To that tick; false if it cannot be read.
  bool Seek(std::uint64_t tick);
  // To that tick or the first one after it that can be read; false if none can.
  bool SeekFrom(std::uint64_t tick);
  // At the tick, as those processes saw it that stepped there.
  const CSwarmanoidSpace& Space() const { return *space_; }
  const TickRecord& Record() const { return record_; }

private:
  // The next record. Of blocks that end before `wanted` without their numbers.
  bool NextRecord(std::uint64_t wanted = 0);
  // To the newest whole state at the tick or before.
  void LoadStateBefore(std::uint64_t tick);

  const JournalBlocks& blocks_;
  const JournalStart& start_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  SpaceSnapshot initial_;              // of the experiment
  std::optional<std::uint64_t> tick_;  // of the space, if it is one of the journal
  std::optional<std::uint64_t> next_;  // the first tick of the blocks that were not read yet
  std::optional<TickRecordReader> records_;
  TickRecord record_;
};

}  // namespace swarmanoid
