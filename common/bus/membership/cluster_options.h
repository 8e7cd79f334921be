// The command-line options that the programs of a cluster share, and those of the workers: declared here, read by the
// programs, and written by whoever starts them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/bus.h"
#include "common/program/options.h"

namespace swarmanoid
{

// --domain, --interface, --peers, --discovery-server, --lease, --datagram, --key, --key-fd and --insecure.
std::vector<OptionSpec> BusOptionTable(BusOptions& options);
// "10.77.0.1:21900" to address and port; nullopt for anything else.
std::optional<std::pair<std::string, unsigned>> ParseServerAddress(const std::string& text);

// What a worker is to do, whichever it is.
struct WorkerSettings
{
  std::string experiment{};  // its name; empty: the first one that is heard
  std::string engine{};
  std::optional<int> region{};  // of that engine; none: the engine itself
  unsigned host = 0;
  // Visualisers: one of the experiment, by its id, or one that is attached, by its kind.
  std::string render{};
  std::string attach{};
  std::string output = ".";
  double rate = 30;
  bool read_only = false;
  std::optional<int> server{};
  unsigned incarnation = 0;
  std::string machine{};
  unsigned threads = 1;  // of a controller host
  // Controllers that killed the hosts before, "TICK:ROBOT" with the number of the entity.
  std::vector<std::string> faults{};
};

// WorkerSettings::faults: tick and entity; nullopt for anything else.
std::optional<std::pair<std::uint64_t, std::uint32_t>> ParseFault(const std::string& text);

std::vector<OptionSpec> EngineOptionTable(WorkerSettings& settings);
std::vector<OptionSpec> HostOptionTable(WorkerSettings& settings);
std::vector<OptionSpec> VisualiserOptionTable(WorkerSettings& settings);

// The words that give a worker, or its bus, these settings.
using WorkerTable = std::vector<OptionSpec> (*)(WorkerSettings&);
std::vector<std::string> WorkerWords(WorkerTable table, WorkerSettings settings);
std::vector<std::string> BusWords(BusOptions options);

}  // namespace swarmanoid
