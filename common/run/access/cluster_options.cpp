#include "common/run/access/cluster_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/configuration/configuration_tree.h"
#include "common/run/access/addresses.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

constexpr double kLargestPid = 1 << 22;
constexpr double kLargestDescriptor = 1'048'575;

std::string ServerAddressMistake(const std::string& text)
{
  return ParseServerAddress(text) ? "" : "it must be an address and a port from 1 to 65535";
}

std::string FaultMistake(const std::string& text) { return ParseFault(text) ? "" : "it must be TICK:ROBOT"; }

OptionSpec ExperimentOption(WorkerSettings& s)
{
  return {Text("experiment", "Name of the experiment; otherwise the first one that is heard"), &s.experiment,
          "diffusion_10"};
}

OptionSpec IncarnationOption(WorkerSettings& s)
{
  return {
      Whole("incarnation",
            "From 1 on: takes the place of a process of the run that has died, of which there were as many", 0, 65535),
      &s.incarnation, "1"};
}

OptionSpec MachineOption(WorkerSettings& s)
{
  return {Text("machine", "The name that the launcher gives to the machine of this process"), &s.machine, "beta"};
}

}  // namespace

std::optional<std::pair<std::uint64_t, std::uint32_t>> ParseFault(const std::string& text)
{
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto tick = ParseInteger(text.substr(0, colon));
  const auto robot = colon < text.size() ? ParseInteger(text.substr(colon + 1)) : std::nullopt;
  if (!tick || !robot || *tick < 0 || *robot < 0 || *robot > std::numeric_limits<std::uint32_t>::max())
    return std::nullopt;
  return std::pair(static_cast<std::uint64_t>(*tick), static_cast<std::uint32_t>(*robot));
}

std::vector<OptionSpec> BusOptionTable(BusOptions& options)
{
  return {
      {Whole("domain", "DDS domain of the experiment; programs of different domains never meet", 0, 232),
       &options.domain, "7"},
      {Text("interface",
            "Network to use: lo (this machine only), all, or the name or IPv4 address of an interface. With --peers or "
            "--discovery-server: all"),
       &options.network_interface, "eth0"},
      {Text("peers", "Machines that take part, where the network has no multicast"),
       &options.peers,
       "alpha,beta",
       "A,B,...",
       {},
       false,
       true},
      {Text("discovery-server",
            "Where the space server listens for the others, where the network has no multicast; the same for all. "
            "Variables of other programs, such as ROS_DISCOVERY_SERVER, are ignored (SWARMANOID_DDS_ENVIRONMENT=1 "
            "keeps them)"),
       &options.discovery_server, "10.77.0.1:21900", "ADDRESS:PORT", ServerAddressMistake},
      {Number("lease", "s", "Silence after which a process counts as dead", 0.2, 3600), &options.lease_s, "10"},
      {{.name = "datagram",
        .type = kInteger,
        .unit = "bytes",
        .description = "Largest datagram; otherwise 65500 on this machine, and 1440, one packet, on a network",
        .minimum = 1024,
        .maximum = 65500},
       &options.datagram_bytes,
       "1440"},
      {Path("key",
            "File with the key of the run, the same on all machines (docs/security.md). Otherwise that of a run of "
            "this user on this machine"),
       &options.key_file, "run.key"},
      {Whole("key-fd", "Descriptor from which the key of the run is read; -1: none", -1, kLargestDescriptor),
       &options.key_fd, "0"},
      {Flag("insecure", "Without a key: every program in the domain may take part, watch and steer"),
       &options.insecure},
  };
}

std::vector<OptionSpec> EngineOptionTable(WorkerSettings& s)
{
  return {
      {Text("engine", "The engine's id in the experiment file"), &s.engine, "ground"},
      {Whole("region", "Number of a region of that engine, from 0, if it is split; otherwise the engine itself", 0, 31),
       &s.region, "1"},
      ExperimentOption(s),
      IncarnationOption(s),
      MachineOption(s)};
}

std::vector<OptionSpec> HostOptionTable(WorkerSettings& s)
{
  return {{Whole("host", "Number of this host; the space server's --controller-hosts says how many there are", 0, 999),
           &s.host, "1"},
          {Whole("threads", "Threads that share the sensors, and the controllers that may step in parallel", 1, 64),
           &s.threads, "2"},
          ExperimentOption(s),
          IncarnationOption(s),
          MachineOption(s),
          {Text("fault",
                "A controller that killed this host before, by tick and number of its robot among the entities: there "
                "it has failed, and is not called"),
           &s.faults, "170:3", "TICK:ROBOT", FaultMistake}};
}

std::vector<OptionSpec> VisualiserOptionTable(WorkerSettings& s)
{
  return {
      {Text("render", "Id of a visualisation of the experiment file; every tick waits for it"), &s.render, "positions"},
      IncarnationOption(s),
      MachineOption(s),
      {Text("attach", "Kind of renderer to attach to a running experiment, which it never slows"), &s.attach, "text"},
      ExperimentOption(s),
      {Path("output", "Folder for relative output files"), &s.output, "watched"},
      {Number("hz", "1/s", "With --attach: states a second at most", 0.01, 30), &s.rate, "1"},
      {Flag("read-only", "With --attach: nothing can be asked of the run through it"), &s.read_only},
      {Whole("server",
             "With --attach: process id of the space server on this machine; the visualiser ends when it has gone", 1,
             kLargestPid),
       &s.server, "17811"}};
}

std::vector<std::string> WorkerWords(WorkerTable table, WorkerSettings settings)
{
  WorkerSettings untouched;
  return WordsOf(table(settings), table(untouched));
}

std::vector<std::string> BusWords(BusOptions options)
{
  BusOptions untouched;
  return WordsOf(BusOptionTable(options), BusOptionTable(untouched));
}

}  // namespace swarmanoid
