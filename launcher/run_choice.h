// Finds the running experiment that a user means.
#pragma once

#include <optional>
#include <string>

#include "common/bus/membership/run_directory.h"

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
  RunNetwork network{};          // of a run of this machine
};

// Returns the only run on this machine, or the run with that name. With a domain, the run may be on another machine.
// Throws UsageError, with a list of the runs, if no run or more than one matches.
RunChoice ChooseRun(const std::string& name, std::optional<int> domain);

// The run of a grant. Throws UsageError unless `name` is empty or its name.
RunChoice RunOf(const AccessToken& token, const std::string& name);

// Throws UsageError if the run is on this machine, and either the run or `options` has no key: they would not
// understand each other.
void CheckInsecure(const RunChoice& run, const BusOptions& options);

// Reaches a run of this machine as its processes reach each other: takes its network unless the user names one, and
// enters the network namespace of an --isolated run.
void UseNetworkOf(const RunChoice& run, BusOptions& options);

// The same as ChooseRun, but waits up to `wait_s` for a run to start, and says so on standard error. At a terminal, the
// user chooses one of several.
RunChoice AwaitRun(const std::string& name, std::optional<int> domain, double wait_s);

}  // namespace swarmanoid
