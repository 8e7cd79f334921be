// Branch: a run that begins at a tick of an earlier run, with that run's state. `swarmanoid run --branch` uses it,
// before the folder of the new run is made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/run/run_options.h"
#include "launcher/branch_changes.h"
#include "launcher/supervision/run_request.h"
#include "launcher/system/scratch_folder.h"

namespace swarmanoid
{

struct BranchRequest
{
  std::string run;  // its folder
  std::uint64_t tick = 0;
};
// Reads "RUN@TICK". Returns nullopt for any other text.
std::optional<BranchRequest> ReadRunAtTick(const std::string& text);
// Returns the same, but throws UsageError.
BranchRequest ReadBranchRequest(const std::string& text);

// Returns the request for a run that branches off, with the values taken from the other run: the experiment, if none is
// named, and the number of controller hosts. Throws UsageError.
RunRequest RequestOfBranch(const RunRequest& request);

class Branch
{
public:
  // Computes the state from the nearest saved one and the recorded inputs, and compares it with the journal. A process
  // of its own does this, since it runs users' code. `experiment`: that of the branch. Throws UsageError if the tick
  // does not exist, or if the state does not fit the experiment.
  Branch(const RunSettings& settings, const Experiment& experiment);

  // If it is not kExitDone, that process failed and has said why.
  int ExitCode() const { return exit_code_; }
  const BranchRequest& Of() const { return request_; }
  std::uint64_t Hash() const { return hash_; }  // Returns the hash of the state at the tick.
  // Returns the tick at which the new run begins. It is earlier than the requested tick if an engine's state cannot be
  // saved there.
  std::uint64_t FirstTick() const { return first_tick_; }
  const std::vector<BranchChange>& Changes() const { return changes_; }

  // Writes the start state of the new run into its folder, and changes the settings so that it starts from it.
  void Install(RunSettings& settings, const Experiment& experiment, const std::string& folder) const;

private:
  void Compute(const RunSettings& settings, const Experiment& experiment);
  std::string EventsBetween(std::uint64_t after, std::uint64_t last, const std::string& file) const;

  BranchRequest request_;
  std::vector<BranchChange> changes_;
  bool matters_ = false;  // some change affects the state
  bool same_fingerprint_ = false;
  ScratchFolder scratch_;
  int exit_code_ = 0;
  std::uint64_t hash_ = 0;
  std::uint64_t first_tick_ = 0;
};

}  // namespace swarmanoid
