// The command-line options that the programs of a cluster share, and the options of the workers. They are declared
// here. The programs read them, and the code that starts a worker writes them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/program/option_parser.h"
#include "common/run/access/bus_options.h"

namespace swarmanoid
{

// Returns the options --domain, --interface, --peers, --discovery-server, --lease, --datagram, --key, --key-fd and
// --insecure.
std::vector<OptionSpec> BusOptionTable(BusOptions& options);

// These options tell a worker of any kind its task.
struct WorkerSettings
{
  std::string experiment{};  // its name; empty: the first one that is heard
  std::string engine{};
  std::optional<int> region{};  // a region of that engine; none: the engine itself
  unsigned host = 0;
  // A visualiser has the id of one in the experiment, or the kind of an attached one.
  std::string render{};
  std::string attach{};
  std::string output = ".";
  double rate = 30;
  bool read_only = false;
  std::optional<int> server{};
  unsigned incarnation = 0;
  std::string machine{};
  unsigned threads = 1;  // for a controller host
  // The controllers that killed earlier hosts, as "TICK:ROBOT" with the number of the entity.
  std::vector<std::string> faults{};
};

// Parses an item of WorkerSettings::faults into tick and entity. Returns nullopt for anything else.
std::optional<std::pair<std::uint64_t, std::uint32_t>> ParseFault(const std::string& text);

std::vector<OptionSpec> EngineOptionTable(WorkerSettings& settings);
std::vector<OptionSpec> HostOptionTable(WorkerSettings& settings);
std::vector<OptionSpec> VisualiserOptionTable(WorkerSettings& settings);

// Returns the options that fill these settings of a worker.
using WorkerTable = std::vector<OptionSpec> (*)(WorkerSettings&);
std::vector<std::string> WorkerWords(WorkerTable table, WorkerSettings settings);
std::vector<std::string> BusWords(BusOptions options);

}  // namespace swarmanoid
