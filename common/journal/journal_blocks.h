// JournalBlocks: the blocks of a journal, found by JournalReader in a run that has ended, or by JournalFollower in one
// that continues.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/journal/journal_writer.h"
#include "common/journal/tick_records.h"

namespace swarmanoid
{

class JournalBlocks
{
public:
  virtual ~JournalBlocks() = default;
  // Returns all blocks except those of repeated ticks, in the order of the files. The ticks of blocks ascend.
  virtual const std::vector<JournalPlace>& Places() const = 0;
  // Returns the content of a block. Throws std::runtime_error if it cannot be read or is damaged.
  virtual std::vector<char> Content(const JournalPlace& place) const = 0;
};

// The ticks from `first` to the one before `end`.
struct TickRange
{
  std::uint64_t first = 0;
  std::uint64_t end = 0;

  bool operator==(const TickRange&) const = default;
};

// Returns the ticks whose whole state can be read, ascending. Blocks of ticks store only changed attributes. After
// damaged blocks, reading therefore continues at the next saved state.
std::vector<TickRange> ReadableTicks(const JournalStart& start, const std::vector<JournalPlace>& places);

// Returns the first tick whose state is complete: that of the run, or of the oldest segment that is left.
std::uint64_t FirstTickOf(const JournalStart& start, const std::vector<JournalPlace>& places);
// Returns the tick after the newest one; the first tick of the journal if it has no ticks.
std::uint64_t EndTickOf(const JournalStart& start, const std::vector<JournalPlace>& places);

}  // namespace swarmanoid
