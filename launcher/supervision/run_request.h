// RunRequest: a user's request to run an experiment. It is immutable, and its options have been checked against each
// other, so later steps of a run meet no contradiction. It and the experiment determine the plan of a cluster.
#pragma once

#include <functional>
#include <utility>

#include "common/run/run_options.h"
#include "launcher/supervision/machines.h"
#include "simulation/watched_simulator.h"

namespace swarmanoid
{

class RunRequest
{
public:
  // Reads the file of --hosts and checks all options against each other. `watch`, if there is one, is called at each
  // tick; then the space server of a cluster is this process. Throws UsageError.
  explicit RunRequest(RunSettings settings, WatchFunction watch = {});

  const RunSettings& Settings() const { return settings_; }
  const RunSettings* operator->() const { return &settings_; }
  // The changes of the experiment file, as the loader takes them.
  const LoadOptions& Changes() const { return changes_; }
  const Machines& ClusterMachines() const { return machines_; }
  const WatchFunction& Watch() const { return watch_; }

  // The same request after `change`, which is the launcher's decision and is not checked: for example the domain.
  RunRequest With(const std::function<void(RunSettings&)>& change) const;

private:
  RunSettings settings_;
  LoadOptions changes_;
  Machines machines_;
  WatchFunction watch_;
};

}  // namespace swarmanoid
