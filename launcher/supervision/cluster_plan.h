// ClusterPlan: which processes run an experiment, what each of them does, and on which machine.
//
// MakePlan derives the plan from the request and the experiment alone. It starts nothing, reads no file, and asks this
// machine nothing. CommandOf turns a process of the plan into the command that starts it. The supervisor owns the plan
// of a running cluster: if a worker moves or the number of controller hosts changes, the supervisor changes the plan,
// and all later commands follow from it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/program/process.h"
#include "common/run/access/cluster_options.h"
#include "common/run/run_options.h"
#include "launcher/supervision/machines.h"
#include "launcher/supervision/run_request.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{

enum class ProcessRole
{
  kSpaceServer,
  kEngine,
  kRegion,
  kControllerHost,
  kVisualiser
};

struct PlannedProcess
{
  std::string name;  // for users and the space server: "engine 'ground'"
  ProcessRole role = ProcessRole::kEngine;
  std::string id{};  // in the file of --hosts: "ground", "ground/2", "0"
  std::string machine = kHere;
  std::string log_path{};
  WorkerSettings worker{};  // for all but the space server
  bool replaceable = true;  // whether another process may take over after its death

  bool IsHere() const { return machine == kHere; }
};

struct ClusterPlan
{
  RunSettings settings{};  // for the space server
  Machines machines{};
  BusOptions bus{};                         // without the key
  std::vector<PlannedProcess> processes{};  // the space server first
  std::size_t robots = 0;
  std::size_t controlled_robots = 0;  // robots that have controllers
  bool is_serial = false;             // one engine in one thread, and no tick ahead: only controller hosts run at once
};

// Makes the plan. Throws UsageError if machines are given for processes that the run does not have, or if the
// experiment needs the network that --isolated takes from it. The request must have the domain.
ClusterPlan MakePlan(const RunRequest& request, const Experiment& experiment);

// Changes the plan to one controller host on each of the machines.
void SetControllerHosts(ClusterPlan& plan, const std::vector<std::string>& machines);

// Returns whether all processes but visualisers run fastest, or are requested to run, on one core of this machine.
bool SharesOneCore(const ClusterPlan& plan);

// Returns a warning before the start if --controller-hosts, `requested`, is more than the robots need or than `cores`
// can run. Otherwise it is empty. 0 cores means that some hosts are on other machines.
std::string NoteAboutControllerHosts(unsigned requested, std::size_t robots, std::size_t cores);

// The controller of this robot took its process with it at this tick.
struct ControllerDeath
{
  std::uint64_t tick = 0;
  std::uint32_t robot = 0;
  bool operator==(const ControllerDeath&) const = default;
};

// How often a process has died and was replaced, and by what.
struct Incarnation
{
  unsigned number = 0;
  double taken_s = 0;                   // by the run, if all processes start again
  std::vector<ControllerDeath> deaths;  // deaths of controllers in the earlier processes
};

// Values that are known only when the processes start.
struct ClusterStart
{
  std::string program_folder;
  std::vector<std::pair<std::string, std::string>> environment;
  std::vector<int> cores;  // cores of the processes, if they share one; empty: all cores
  std::string key;         // a process reads it from its standard input; empty: the run has no key
};

ProcessCommand CommandOf(const ClusterPlan& plan, const ClusterStart& start, std::size_t process,
                         const Incarnation& incarnation = {});

}  // namespace swarmanoid
