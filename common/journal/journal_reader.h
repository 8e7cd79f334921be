// JournalReader: the journal of a run that has ended, however it did. Blocks are found one after the other, in all
// segments that are there; the first one that is cut short or damaged ends it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/checkpoint/checkpoint.h"
#include "common/configuration/regular_file.h"
#include "common/journal/journal_blocks.h"
#include "common/journal/journal_format.h"
#include "common/journal/journal_writer.h"
#include "common/journal/tick_records.h"

namespace swarmanoid
{

class JournalReader : public JournalBlocks
{
public:
  // Throws std::runtime_error, with the path, if it cannot be read or is no journal of this version.
  explicit JournalReader(const std::string& path);

  const JournalStart& Start() const { return start_; }
  // The controller hosts at the end; at first there may have been others.
  const HostTable& Hosts() const { return tables_.back(); }
  // Those that stepped at a tick that the journal has.
  const HostTable& HostsAt(std::uint64_t tick) const;
  // By the numbers that places have.
  const std::vector<HostTable>& Tables() const { return tables_; }
  const std::string& Path() const { return path_; }
  // All whole blocks but those of ticks that were done again, in the order of the file.
  const std::vector<JournalPlace>& Places() const override { return places_; }
  // Of whole blocks, in all segments and in the newest one.
  std::uint64_t Bytes() const { return bytes_; }
  std::uint64_t NewestSegmentBytes() const { return newest_bytes_; }
  std::uint32_t NewestSegment() const { return newest_; }
  // Bytes after the last whole block: what was being written when the run died.
  std::uint64_t TornBytes() const { return torn_; }
  std::vector<char> Content(const JournalPlace& place) const override;
  // The first tick of which there is all: that of the run, or of the oldest segment that is left.
  std::uint64_t FirstTick() const { return FirstTickOf(start_, places_); }
  // Calls `use` with each tick. Some may be lacking at the end.
  void ForEachTick(const std::function<void(const TickRecord&)>& use) const;
  // The newest tick at which the space server was saved and before which none is lacking, nor itself; nothing if there
  // is none. `usable`: false for ticks that will not do.
  std::optional<std::uint64_t> TickToGoOn(const std::function<bool(std::uint64_t)>& usable) const;
  std::optional<TickRecord> RecordOf(std::uint64_t tick) const;
  // Of controllers, in the steps from that tick on. `ahead`: ticks until commands, which tell of them, act.
  KnownFaults FaultsFrom(std::uint64_t tick, std::uint32_t ahead) const;
  // What all `parts` saved at the tick, or at the newest one that has them all, put together; nothing if one is
  // lacking. `table`: saved by these controller hosts.
  std::optional<Checkpoint> CheckpointAt(std::uint64_t tick, const std::vector<std::string>& parts,
                                         std::optional<std::uint32_t> table = std::nullopt) const;
  std::optional<Checkpoint> NewestCheckpoint(const std::vector<std::string>& parts) const;
  // What all processes saved at the tick, or at the newest one until then at which all did, for these controller hosts,
  // whichever the run had.
  std::optional<Checkpoint> WholeCheckpointAt(std::uint64_t tick, const Experiment& experiment,
                                              const HostTable& hosts) const;
  std::optional<Checkpoint> WholeCheckpointUntil(std::uint64_t tick, const Experiment& experiment,
                                                 const HostTable& hosts) const;

private:
  // The block that has the tick; none if there is none.
  const JournalPlace* TicksWith(std::uint64_t tick) const;
  const JournalPlace* PlaceOf(JournalBlockKind kind, std::uint64_t tick, const std::string& name,
                              std::optional<std::uint32_t> table = std::nullopt) const;

  std::string path_;
  // The blocks of one segment; false if another one cannot follow.
  bool ReadSegment(std::uint32_t segment);

  std::vector<std::pair<std::uint32_t, std::unique_ptr<RegularFile>>> files_;
  JournalStart start_;
  std::vector<JournalPlace> places_;
  std::vector<HostTable> tables_;
  std::uint64_t bytes_ = 0;
  std::uint64_t newest_bytes_ = 0;
  std::uint32_t newest_ = 0;
  std::uint64_t torn_ = 0;
};

// Whether there is anything of it.
bool IsBegun(const std::string& path);

// Where the space server writes it, in the folder of the run.
std::string JournalFile(const std::string& run_folder);

// FaultsFrom of the journal of a run of the same experiment; none if no controller has a guard. Throws
// std::runtime_error, with the path.
KnownFaults FaultsOfRun(const std::string& run_folder, const Experiment& experiment, std::uint64_t tick);

}  // namespace swarmanoid
