// Which running experiment a user means.
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
  bool lets_anybody_in = false;  // likewise: it was started with --insecure
  RunNetwork network{};          // likewise
};

// The one on this machine, or the one of that name. With a domain, experiments of other machines can be meant too.
// Throws UsageError, listing those that run, if there is none or more than one.
RunChoice ChooseRun(const std::string& name, std::optional<int> domain);

// The one of a grant; `name` is empty or its name, or UsageError.
RunChoice RunOf(const AccessToken& token, const std::string& name);

// Throws UsageError if the run is on this machine and has a key, while no key is to be used, or the other way round:
// the two would not understand each other.
void CheckInsecure(const RunChoice& run, const BusOptions& options);

// Reaches a run of this machine as its processes reach each other: takes its network unless the user names one, and
// enters the network namespace of an --isolated run.
void UseNetworkOf(const RunChoice& run, BusOptions& options);

// The same as ChooseRun, but for so many seconds it waits for one to start, and says so on the standard error; of
// several, who sits at a terminal is asked for one.
RunChoice AwaitRun(const std::string& name, std::optional<int> domain, double wait_s);

}  // namespace swarmanoid
