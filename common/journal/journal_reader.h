// JournalReader: the journal of a run that has ended, however it did. Blocks are found one after the other; the first
// one that is cut short or damaged ends it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/checkpoint/checkpoint.h"
#include "common/configuration/regular_file.h"
#include "common/journal/journal_format.h"
#include "common/journal/journal_writer.h"
#include "common/journal/tick_records.h"

namespace swarmanoid
{

class JournalReader
{
public:
  // Throws std::runtime_error, with the path, if it cannot be read or is no journal of this version.
  explicit JournalReader(const std::string& path);

  const JournalStart& Start() const { return start_; }
  // All whole blocks, in the order of the file.
  const std::vector<JournalPlace>& Places() const { return places_; }
  // Bytes after the last whole block: what was being written when the run died.
  std::uint64_t TornBytes() const { return torn_; }
  std::vector<char> Content(const JournalPlace& place) const;
  // Calls `use` with each tick. Some may be lacking at the end.
  void ForEachTick(const std::function<void(const TickRecord&)>& use) const;
  // The newest tick at which all `parts` were saved, put together; nothing if there is none.
  std::optional<Checkpoint> NewestCheckpoint(const std::vector<std::string>& parts) const;

private:
  RegularFile file_;
  JournalStart start_;
  std::vector<JournalPlace> places_;
  std::uint64_t torn_ = 0;
};

// Where the space server writes it, in the folder of the run.
std::string JournalFile(const std::string& run_folder);

}  // namespace swarmanoid
