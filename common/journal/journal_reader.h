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
  const std::string& Path() const { return path_; }
  // All whole blocks but those of ticks that were done again, in the order of the file.
  const std::vector<JournalPlace>& Places() const { return places_; }
  // Of whole blocks.
  std::uint64_t Bytes() const { return file_.Size() - torn_; }
  // Bytes after the last whole block: what was being written when the run died.
  std::uint64_t TornBytes() const { return torn_; }
  std::vector<char> Content(const JournalPlace& place) const;
  // Calls `use` with each tick. Some may be lacking at the end.
  void ForEachTick(const std::function<void(const TickRecord&)>& use) const;
  // The newest tick at which the space server was saved and before which none is lacking, nor itself; nothing if there
  // is none. `usable`: false for ticks that will not do.
  std::optional<std::uint64_t> TickToGoOn(const std::function<bool(std::uint64_t)>& usable) const;
  std::optional<TickRecord> RecordOf(std::uint64_t tick) const;
  // Of controllers, in the ticks from that one on.
  KnownFaults FaultsFrom(std::uint64_t tick) const;
  // What all `parts` saved at the tick, or at the newest one that has them all, put together; nothing if one is
  // lacking.
  std::optional<Checkpoint> CheckpointAt(std::uint64_t tick, const std::vector<std::string>& parts) const;
  std::optional<Checkpoint> NewestCheckpoint(const std::vector<std::string>& parts) const;

private:
  const JournalPlace* PlaceOf(JournalBlockKind kind, std::uint64_t tick, const std::string& name) const;

  std::string path_;
  RegularFile file_;
  JournalStart start_;
  std::vector<JournalPlace> places_;
  std::uint64_t torn_ = 0;
};

// Where the space server writes it, in the folder of the run.
std::string JournalFile(const std::string& run_folder);

// FaultsFrom of the journal of a run of the same experiment; none if no controller has a guard. Throws
// std::runtime_error, with the path.
KnownFaults FaultsOfRun(const std::string& run_folder, const Experiment& experiment, std::uint64_t tick);

}  // namespace swarmanoid
