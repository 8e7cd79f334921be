// Finds the running experiment that a user means.
#pragma once

#include <optional>
#include <string>

#include "common/run/access/run_directory.h"

namespace swarmanoid
{

struct BusOptions;
struct AccessToken;

struct RunChoice
{
  std::string experiment;
  int domain = 0;
  std::optional<int> server;     // process id of its space server, if that is on this machine
  bool lets_anybody_in = false;  // whether a run of this machine was started with --insecure
  RunNetwork network{};          // network of a run on this machine
};

// Returns the only run on this machine, or the run with that name. With a domain, the run may be on another machine.
// Throws UsageError, with a list of the runs, if no run or more than one matches.
RunChoice ChooseRun(const std::string& name, std::optional<int> domain);

// The run of a grant. Throws UsageError unless `name` is empty or its name.
RunChoice RunOf(const AccessToken& token, const std::string& name);

// Throws UsageError if the run is on this machine, and either the run or `options` has no key: they would not
// understand each other.
void CheckInsecure(const RunChoice& run, const BusOptions& options);

// Uses the network of a run's processes on this machine, unless the user names one. Enters the network namespace of an
// --isolated run.
void UseNetworkOf(const RunChoice& run, BusOptions& options);

// Waits for the next start of the experiment of a run on this machine. Returns nothing if the user interrupts it.
std::optional<RunChoice> AwaitNextRun(const RunChoice& run);

// The same as ChooseRun, but waits up to `wait_s` for a run to start, and says so on standard error. At a terminal, the
// user chooses one of several.
RunChoice AwaitRun(const std::string& name, std::optional<int> domain, double wait_s);

}  // namespace swarmanoid
