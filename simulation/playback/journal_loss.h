// What the journal of a run lacks: damaged bytes, and the ticks that are lost with them or were never written. Used by
// every command that reads a journal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/journal/journal_reader.h"

namespace swarmanoid
{

struct JournalLoss
{
  // Whether something is lost. A torn end alone is none: the run was killed while it wrote.
  bool is_damaged = false;
  // For the user, a sentence each.
  std::vector<std::string> notes;
};

// The end of a run, according to its manifest.
struct RecordedEnd
{
  std::optional<std::uint64_t> last_tick;  // nothing: the run died, or goes on
  bool has_budget = false;                 // the oldest segments of the journal may have been deleted
  std::string trouble;                     // why the manifest cannot be read; empty if it can or there is none
};
RecordedEnd RecordedEndOf(const std::string& run_folder);

// Compares a journal with what the run was.
JournalLoss FindLoss(const JournalReader& journal, const RecordedEnd& end);

// Prints the notes as warnings of a command.
void PrintLoss(const JournalLoss& loss);

}  // namespace swarmanoid
