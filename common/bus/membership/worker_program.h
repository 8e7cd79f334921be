// The common main function of the workers: engine_worker, controller_host and visualiser.
#pragma once

#include <fmt/format.h>
#include <functional>

#include "common/bus/membership/tick_gate.h"
#include "common/experiment/experiment.h"
#include "common/program/program.h"
#include "common/run/access/cluster_options.h"

namespace swarmanoid
{

// Runs a program with a worker's options, the bus options, and the options that `declare` adds.
int RunWorker(const ProgramDescription& program, int count, char** arguments, WorkerTable table,
              const std::function<int(const WorkerSettings&, const BusOptions&)>& run,
              const std::function<void(CLI::App&)>& declare = nullptr);

// Returns the number of the engine or visualisation (`kind`) with that id.
template <class Part>
std::size_t NumberOf(const Experiment& experiment, const std::vector<Part>& parts, const char* kind,
                     const std::string& id)
{
  std::vector<std::string> known;
  for (const Part& part : parts)
  {
    if (part.id == id) return static_cast<std::size_t>(&part - parts.data());
    known.push_back("'" + part.id + "'");
  }
  throw ConfigurationError(fmt::format("experiment '{}' has no {} '{}'; it has {}", experiment.name, kind, id,
                                       known.empty() ? "none" : Joined(known)));
}

}  // namespace swarmanoid
