// JournalReader: the journal of a run that has ended, however it did. It reads all blocks of all segments, skips those
// that are damaged, and says which bytes it skipped.
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
  // Throws std::runtime_error, with the path, if it cannot be read or is no journal of this version.
  explicit JournalReader(const std::string& path);

  // Throws std::runtime_error, with the path, if the block that has it is damaged.
  const JournalStart& Start() const;
  // The same. If that block is damaged, it has no origin and no hosts, and a guess at the first tick.
  const JournalStart& StartAsFarAsKnown() const { return start_; }
  bool HasStart() const { return !tables_.empty(); }
  // The controller hosts at the end; at first there may have been others. Throws as Start does.
  const HostTable& Hosts() const;
  // Those that stepped at a tick that the journal has. Throws std::runtime_error if they are not known.
  const HostTable& HostsAt(std::uint64_t tick) const;
  bool KnowsHostsAt(std::uint64_t tick) const;
  // By the numbers that places have.
  const std::vector<HostTable>& Tables() const { return tables_; }
  const std::string& Path() const { return path_; }
  // All whole blocks but those of ticks that were done again, in the order of the file.
  const std::vector<JournalPlace>& Places() const override { return places_; }
  // Up to the end of the newest whole block, in all segments and in the newest one that a run can go on with.
  std::uint64_t Bytes() const { return bytes_; }
  std::uint64_t NewestSegmentBytes() const { return newest_bytes_; }
  std::uint32_t NewestSegment() const { return newest_; }
  // Bytes after the last whole block that are the start of another one: what was being written when the run died.
  std::uint64_t TornBytes() const { return torn_; }
  // In the order of the files.
  const std::vector<JournalDamage>& Damages() const { return damages_; }
  std::vector<char> Content(const JournalPlace& place) const override;
  // The first tick of which there is all: that of the run, or of the oldest segment that is left.
  std::uint64_t FirstTick() const { return FirstTickOf(start_, places_); }
  // Calls `use` with each tick. Some may be lacking at the end.
  void ForEachTick(const std::function<void(const TickRecord&)>& use) const;
  // The newest tick at which the space server was saved and before which none is lacking, nor itself; nothing if there
  // is none. `usable`: false for ticks that will not do.
  std::optional<std::uint64_t> RestartTick(const std::function<bool(std::uint64_t)>& usable) const;
  std::optional<TickRecord> RecordOf(std::uint64_t tick) const;
  // Of controllers, in the steps from that tick on. `ahead`: ticks until commands, which tell of them, act.
  RecordedFaults FaultsFrom(std::uint64_t tick, std::uint32_t ahead) const;
  // Returns the saved states of all `parts` at the tick, or nothing if one is missing. With `table`, only states that
  // these controller hosts saved count.
  std::optional<Checkpoint> CheckpointAt(std::uint64_t tick, const std::vector<std::string>& parts,
                                         std::optional<std::uint32_t> table = std::nullopt) const;
  // What all processes saved at the tick, or at the newest one until then at which all did, for these controller hosts,
  // whichever the run had.
  std::optional<Checkpoint> WholeCheckpointAt(std::uint64_t tick, const Experiment& experiment,
                                              const HostTable& hosts) const;
  std::optional<Checkpoint> WholeCheckpointUntil(std::uint64_t tick, const Experiment& experiment,
                                                 const HostTable& hosts) const;
  // Whether the newest controller hosts, and all others of `parts`, saved a tick until then.
  bool NewestHostsSavedUntil(std::uint64_t tick, const std::vector<std::string>& parts) const;

private:
  void ReadAll();
  // The blocks of one segment; false if it is of another run.
  bool ReadSegment(std::uint32_t segment, bool is_newest);
  // The block of a segment whose table of hosts has that number. False if its content is damaged.
  bool Take(const SegmentPart& part, JournalPlace place);
  // The block that has the tick; none if there is none.
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

// Whether there is anything of it.
bool IsBegun(const std::string& path);

// Where the space server writes it, in the folder of the run.
std::string JournalFile(const std::string& run_folder);

// FaultsFrom of the journal of a run of the same experiment; none if no controller has a guard. Throws
// std::runtime_error, with the path.
RecordedFaults FaultsOfRun(const std::string& run_folder, const Experiment& experiment, std::uint64_t tick);

}  // namespace swarmanoid
