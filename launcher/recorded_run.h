// A run that is over, tick after tick as its journal has it; and where two runs of one experiment part. Used by
// `replay`, `diff` and `export`.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/journal/journal_reader.h"
#include "common/space/space.h"

namespace swarmanoid
{

class RecordedRun
{
public:
  // `folder`: of the run. Throws UsageError if it has no journal, or one that does not say where the run began.
  explicit RecordedRun(const std::string& folder);

  const std::string& Folder() const { return folder_; }
  const Experiment& GetExperiment() const { return *experiment_; }
  // To the next tick, at first to the first one; false after the last one.
  bool Next();
  // At the tick, as those processes saw it that stepped there.
  const CSwarmanoidSpace& Space() const { return space_; }
  const TickRecord& Record() const { return record_; }

private:
  std::string folder_;
  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<JournalReader> journal_;
  CSwarmanoidSpace space_;
  std::size_t place_ = 0;
  std::optional<TickRecordReader> records_;
  TickRecord record_;
};

// The first entity, and what of it, that has other bits in `b`, with both values, as "x of 'fb_3' is 1.25 and 1.5";
// empty if there is none. Both spaces are of one experiment.
std::string FirstDifference(const CSwarmanoidSpace& a, const CSwarmanoidSpace& b);

}  // namespace swarmanoid
