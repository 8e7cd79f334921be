// JournalReader: reads the journal of a run that has ended or died. It reads all blocks of all segments, skips damaged
// ones, and reports which bytes it skipped.
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
#include "common/journal/journal_segment.h"
#include "common/journal/journal_writer.h"
#include "common/journal/tick_records.h"

namespace swarmanoid
{

// Bytes of a journal that cannot be read.
struct JournalDamage
{
  std::string file;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;  // 0: the whole file is missing

  bool operator==(const JournalDamage&) const = default;
};

class JournalReader : public JournalBlocks
{
public:
  // Throws std::runtime_error with the path if the file cannot be read or is no journal of this version.
  explicit JournalReader(const std::string& path);

  // Returns the start of the run. Throws std::runtime_error with the path if its block is damaged.
  const JournalStart& Start() const;
  // Returns the same. If that block is damaged, the result has no origin, no hosts, and an estimated first tick.
  const JournalStart& StartAsFarAsKnown() const { return start_; }
  bool HasStart() const { return !tables_.empty(); }
  // Returns the controller hosts at the end; they may differ from those at the start. Throws as Start does.
  const HostTable& Hosts() const;
  // Returns the controller hosts at a tick of the journal. Throws std::runtime_error if they are unknown.
  const HostTable& HostsAt(std::uint64_t tick) const;
  bool KnowsHostsAt(std::uint64_t tick) const;
  // Returns the tables of hosts, indexed by JournalPlace::table.
  const std::vector<HostTable>& Tables() const { return tables_; }
  const std::string& Path() const { return path_; }
  // Returns all whole blocks except those of repeated ticks, in the order of the file.
  const std::vector<JournalPlace>& Places() const override { return places_; }
  // Returns the bytes up to the end of the newest whole block: in all segments, and in the newest one that a run can
  // continue.
  std::uint64_t Bytes() const { return bytes_; }
  std::uint64_t NewestSegmentBytes() const { return newest_bytes_; }
  std::uint32_t NewestSegment() const { return newest_; }
  // Returns the bytes after the last whole block that are the start of another one, which was being written when the
  // run died.
  std::uint64_t TornBytes() const { return torn_; }
  // Returns the damages in the order of the files.
  const std::vector<JournalDamage>& Damages() const { return damages_; }
  std::vector<char> Content(const JournalPlace& place) const override;
  // Returns the first tick whose state is complete: that of the run, or of the oldest segment that is left.
  std::uint64_t FirstTick() const { return FirstTickOf(start_, places_); }
  // Calls `use` with each tick. Some ticks may be missing at the end.
  void ForEachTick(const std::function<void(const TickRecord&)>& use) const;
  // Returns the newest tick at which the space server was saved and up to which no tick is missing; nothing if none
  // exists. `usable` returns false for ticks to skip.
  std::optional<std::uint64_t> RestartTick(const std::function<bool(std::uint64_t)>& usable) const;
  std::optional<TickRecord> RecordOf(std::uint64_t tick) const;
  // Returns the faults of controllers in the steps from that tick on. `ahead`: ticks until the commands that report a
  // fault take effect.
  RecordedFaults FaultsFrom(std::uint64_t tick, std::uint32_t ahead) const;
  // Returns the saved states of all `parts` at the tick, or nothing if one is missing. With `table`, only states that
  // these controller hosts saved count.
  std::optional<Checkpoint> CheckpointAt(std::uint64_t tick, const std::vector<std::string>& parts,
                                         std::optional<std::uint32_t> table = std::nullopt) const;
  // Returns the states that all processes saved at the tick, or at the newest earlier tick at which all did, converted
  // to these controller hosts.
  std::optional<Checkpoint> WholeCheckpointAt(std::uint64_t tick, const Experiment& experiment,
                                              const HostTable& hosts) const;
  std::optional<Checkpoint> WholeCheckpointUntil(std::uint64_t tick, const Experiment& experiment,
                                                 const HostTable& hosts) const;
  // Returns whether the newest controller hosts, and all others of `parts`, saved a tick up to that one.
  bool NewestHostsSavedUntil(std::uint64_t tick, const std::vector<std::string>& parts) const;

private:
  void ReadAll();
  // Reads the blocks of one segment; returns false if it is of another run.
  bool ReadSegment(std::uint32_t segment, bool is_newest);
  // Adds a block of a segment whose table of hosts has that number. Returns false if its content is damaged.
  bool Take(const SegmentPart& part, JournalPlace place);
  // Returns the block that has the tick; nullptr if none does.
  const JournalPlace* TicksWith(std::uint64_t tick) const;
  const JournalPlace* PlaceOf(JournalBlockKind kind, std::uint64_t tick, const std::string& name,
                              std::optional<std::uint32_t> table = std::nullopt) const;

  std::string path_;
  std::vector<std::pair<std::uint32_t, std::unique_ptr<RegularFile>>> files_;
  JournalStart start_;
  std::vector<JournalPlace> places_;
  std::vector<HostTable> tables_;
  std::uint64_t bytes_ = 0;
  std::uint64_t newest_bytes_ = 0;
  std::uint32_t newest_ = 0;
  std::uint64_t torn_ = 0;
  std::vector<JournalDamage> damages_;
};

// Returns whether the journal has any content.
bool IsBegun(const std::string& path);

// Returns the path of the journal in the folder of a run, where the space server writes it.
std::string JournalFile(const std::string& run_folder);

// Returns FaultsFrom of the journal of a run of the same experiment; nothing if no controller has a guard. Throws
// std::runtime_error with the path.
RecordedFaults FaultsOfRun(const std::string& run_folder, const Experiment& experiment, std::uint64_t tick);

}  // namespace swarmanoid
