// Finds the missing parts of a run's journal: damaged bytes, and the ticks that are lost with them or were never
// written. Every command that reads a journal uses it.
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
  // It is true if something is lost. A torn end alone is no loss: the run was killed while it wrote.
  bool is_damaged = false;
  // The user gets these losses, one sentence each.
  std::vector<std::string> notes;
};

// The end of a run, according to its manifest.
struct RecordedEnd
{
  std::optional<std::uint64_t> last_tick;  // nothing: the run died, or continues
  bool has_budget = false;                 // the oldest segments of the journal may have been deleted
  std::string trouble;                     // why the manifest cannot be read; empty if it can be read or does not exist
};
RecordedEnd RecordedEndOf(const std::string& run_folder);

// Compares a journal with the end of its run.
JournalLoss FindLoss(const JournalReader& journal, const RecordedEnd& end);

// Prints the notes as warnings of a command.
void PrintLoss(const JournalLoss& loss);

}  // namespace swarmanoid
