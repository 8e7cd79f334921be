// JournalBlocks: the blocks of a journal, whoever found them: JournalReader, of a run that is over, or JournalFollower.
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
  // All but those of ticks that were done again, in the order of the files; those of ticks ascend.
  virtual const std::vector<JournalPlace>& Places() const = 0;
  // Throws std::runtime_error if it cannot be read, or is damaged.
  virtual std::vector<char> Content(const JournalPlace& place) const = 0;
};

// The ticks from `first` up to the one before `end`.
struct TickRange
{
  std::uint64_t first = 0;
  std::uint64_t end = 0;

  bool operator==(const TickRange&) const = default;
};

// The ticks whose whole state can be read, ascending. Blocks of ticks say only which attributes change. After blocks
// that are damaged, reading therefore goes on at the next saved state.
std::vector<TickRange> ReadableTicks(const JournalStart& start, const std::vector<JournalPlace>& places);

// The first tick of which there is all: that of the run, or where the oldest segment that is left was begun.
std::uint64_t FirstTickOf(const JournalStart& start, const std::vector<JournalPlace>& places);
// The tick after the newest one; that where the journal begins if there is none.
std::uint64_t EndTickOf(const JournalStart& start, const std::vector<JournalPlace>& places);

}  // namespace swarmanoid
