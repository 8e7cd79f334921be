// RecordedRun: a run that has ended, tick by tick from its journal. FirstDifference compares two runs of one
// experiment. `swarmanoid replay`, `diff` and `export` use it.
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
  // `folder`: the folder of the run. Throws UsageError if it has no journal.
  explicit RecordedRun(const std::string& folder);

  const std::string& Folder() const { return folder_; }
  const Experiment& GetExperiment() const { return *experiment_; }
  const JournalReader& Journal() const { return *journal_; }
  // These functions are those of RecordedStates.
  bool Next() { return states_->Next(); }
  bool Seek(std::uint64_t tick) { return states_->Seek(tick); }
  bool SeekFrom(std::uint64_t tick) { return states_->SeekFrom(tick); }
  const CSwarmanoidSpace& Space() const { return states_->Space(); }
  const TickRecord& Record() const { return states_->Record(); }
  std::uint64_t FirstTick() const { return journal_->FirstTick(); }
  std::uint64_t LastTick() const;
  // Returns the parts that cannot be read.
  const JournalLoss& Loss() const { return loss_; }
  // Returns the exit code of a command that has printed the loss. It is `code`, or that of a failure if `code` is
  // success and the journal is damaged.
  int ExitCode(int code) const;

private:
  std::string folder_;
  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<JournalReader> journal_;
  JournalLoss loss_;
  std::optional<RecordedStates> states_;
};

// Returns the first difference between two spaces of one experiment, such as "x of 'fb_3' is 1.25 and 1.5"; empty if
// all bits are equal.
std::string FirstDifference(const CSwarmanoidSpace& a, const CSwarmanoidSpace& b);

}  // namespace swarmanoid
