// A run that is over, tick after tick as its journal has it; and where two runs of one experiment part. Used by
// `replay`, `diff` and `export`.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/journal/journal_reader.h"
#include "common/journal/recorded_states.h"
#include "simulation/playback/journal_loss.h"

namespace swarmanoid
{

class RecordedRun
{
public:
  // `folder`: of the run. Throws UsageError if it has no journal.
  explicit RecordedRun(const std::string& folder);

  const std::string& Folder() const { return folder_; }
  const Experiment& GetExperiment() const { return *experiment_; }
  const JournalReader& Journal() const { return *journal_; }
  // As those of RecordedStates.
  bool Next() { return states_->Next(); }
  bool Seek(std::uint64_t tick) { return states_->Seek(tick); }
  bool SeekFrom(std::uint64_t tick) { return states_->SeekFrom(tick); }
  const CSwarmanoidSpace& Space() const { return states_->Space(); }
  const TickRecord& Record() const { return states_->Record(); }
  std::uint64_t FirstTick() const { return journal_->FirstTick(); }
  std::uint64_t LastTick() const;
  // The parts that cannot be read.
  const JournalLoss& Loss() const { return loss_; }
  // The exit code of a command that has printed the loss: that of a failure if the journal is damaged, unless it has
  // another one already.
  int ExitCode(int code) const;

private:
  std::string folder_;
  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<JournalReader> journal_;
  JournalLoss loss_;
  std::optional<RecordedStates> states_;
};

// The first entity, and what of it, that has other bits in `b`, with both values, as "x of 'fb_3' is 1.25 and 1.5";
// empty if there is none. Both spaces are of one experiment.
std::string FirstDifference(const CSwarmanoidSpace& a, const CSwarmanoidSpace& b);

}  // namespace swarmanoid
