#include "launcher/supervision/cluster_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <string_view>

#include "common/configuration/wording.h"
#include "common/messages/assignment.h"
#include "common/program/usage_error.h"
#include "common/run/visualiser_name.h"

namespace swarmanoid
{
namespace
{

// Up to this number, wake-ups across cores cost more than the parallel work saves (10 robots: 51 us a tick on one core,
// 70 us on two).
constexpr std::size_t kRobotsForOneCore = 300;
constexpr std::size_t kHostsForOneCore = 8;  // the start of more takes long with one core
// The same if the processes work one after the other: their messages stay in the core's cache (300 robots: 1.37 times
// as fast on one core as on two, 1,000: 1.2, 2,000: 1.15, 4,000: as fast).
constexpr std::size_t kRobotsInTurnForOneCore = 3000;

struct RoleRow
{
  const char* word;     // in the file of --hosts
  const char* program;  // and the beginning of the log's name
  WorkerTable options;
};

const RoleRow& RowOf(ProcessRole role)
{
  static constexpr std::array<RoleRow, 5> kRows{{{"space_server", "space_server", nullptr},
                                                 {"engine", "engine_worker", EngineOptionTable},
                                                 {"region", "engine_worker", EngineOptionTable},
                                                 {"controller_host", "controller_host", HostOptionTable},
                                                 {"visualiser", "visualiser", VisualiserOptionTable}}};
  return kRows[static_cast<std::size_t>(role)];
}

// Returns the path of a process's log. Ids may hold any characters, so some are replaced.
std::string LogPath(const ClusterPlan& plan, const PlannedProcess& process)
{
  std::string name = RowOf(process.role).program;
  if (!process.id.empty()) name += "-" + process.id;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.') c = '_';
  return plan.settings.output_folder + "/" + name + ".log";
}

void Append(std::vector<std::string>& words, const std::vector<std::string>& more)
{
  words.insert(words.end(), more.begin(), more.end());
}

BusOptions BusOf(const RunRequest& request)
{
  // The launcher sees deaths on this machine, and a process that a debugger has stopped is not dead.
  constexpr double kForEver_s = 3600;
  BusOptions bus;
  bus.domain = request->domain.value_or(bus.domain);
  if (request.ClusterMachines().AllHere()) bus.lease_s = kForEver_s;
  if (request->lease_s > 0) bus.lease_s = request->lease_s;
  bus.insecure = request->insecure;
  if (!request->insecure) bus.key_fd = STDIN_FILENO;
  return bus;
}

std::size_t HostCount(const ClusterPlan& plan)
{
  return static_cast<std::size_t>(
      std::ranges::count(plan.processes, ProcessRole::kControllerHost, &PlannedProcess::role));
}

void Add(ClusterPlan& plan, ProcessRole role, const std::string& name, const std::string& id,
         const WorkerSettings& worker)
{
  PlannedProcess process{.name = name, .role = role, .id = id, .worker = worker};
  process.machine = plan.machines.MachineOf(RowOf(role).word, id);
  process.log_path = LogPath(plan, process);
  plan.processes.push_back(process);
}

void RefuseUnknownIds(const ClusterPlan& plan, ProcessRole role)
{
  std::vector<std::string> known;
  for (const PlannedProcess& process : plan.processes)
    if (process.role == role && !process.id.empty()) known.push_back(process.id);
  const char* word = RowOf(role).word;
  for (const std::string& id : plan.machines.Named(word))
    if (std::ranges::find(known, id) == known.end())
      throw UsageError(fmt::format("a host is given for {} {}, which the experiment does not have; it has {}{}", word,
                                   Quoted(id), Listed(known), DidYouMean(id, known)));
}

// Refuses parts of the experiment that are of no use without others in the network.
void RefuseIsolated(const RunSettings& settings, const Experiment& experiment)
{
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kReached{
      {{"web_render", "no browser could reach the page of"},
       {"foxglove_render", "no program could connect to"},
       {"ros2_render", "no node of ROS 2 could hear"}}};
  for (const RenderConfiguration& render : experiment.visualisations)
    for (const auto& [tag, why] : kReached)
      if (settings.visualisations && render.tag == tag)
        throw UsageError(fmt::format("--isolated: {} {}; give --no-visualisers, or leave --isolated out", why,
                                     VisualiserName(render)));
  for (const ControllerConfiguration& controller : experiment.controllers)
    if (controller.tag == "ros2_controller")
      throw UsageError(fmt::format(
          "--isolated: no node of ROS 2 could reach the robots of the controller '{}'; leave it out", controller.id));
}

std::vector<std::string> ServerArguments(const ClusterPlan& plan, const Incarnation& incarnation)
{
  RunSettings settings = plan.settings;
  settings.controller_hosts = static_cast<unsigned>(HostCount(plan));
  std::vector<std::string> words = ServerWords(settings);
  Append(words, {"--status-fd", "1"});
  if (settings.Replaces())
  {
    Append(words, {"--await-replacements"});
    // Users may ask to move workers to these machines.
    Append(words, {"--machine", kHere});
    for (const std::string& machine : plan.machines.Names()) Append(words, {"--machine", machine});
    for (const PlannedProcess& process : plan.processes)
      Append(words, {"--place", process.name + "=" + process.machine});
  }
  if (incarnation.number > 0) Append(words, {"--go-on", fmt::format("{}", incarnation.taken_s)});
  return words;
}

std::vector<std::string> WorkerArguments(const PlannedProcess& process, const Incarnation& incarnation)
{
  WorkerSettings worker = process.worker;
  worker.machine = process.machine;
  worker.incarnation = incarnation.number;
  for (const ControllerDeath& death : incarnation.deaths)
    worker.faults.push_back(fmt::format("{}:{}", death.tick, death.robot));
  return WorkerWords(RowOf(process.role).options, worker);
}

}  // namespace

ClusterPlan MakePlan(const RunRequest& request, const Experiment& experiment)
{
  if (request->isolated) RefuseIsolated(request.Settings(), experiment);
  ClusterPlan plan{.settings = request.Settings(), .machines = request.ClusterMachines(), .bus = BusOf(request)};

  Add(plan, ProcessRole::kSpaceServer, "space server", "", {});
  // On another machine, a server that seems dead may live on unseen. In this process nothing can replace it.
  PlannedProcess& server = plan.processes.front();
  server.replaceable = request->Replaces() && server.IsHere() && !request.Watch();
  const std::vector<EngineConfiguration>& engines = experiment.engines;
  for (std::size_t e = 0; e < engines.size(); ++e)
    Add(plan, ProcessRole::kEngine, EngineName(experiment, e), engines[e].id,
        {.experiment = experiment.name, .engine = engines[e].id});
  for (std::size_t e = 0; e < engines.size(); ++e)
    for (unsigned region = 0; region < RegionsOf(engines[e]); ++region)
      Add(plan, ProcessRole::kRegion, RegionName(experiment, e, region), fmt::format("{}/{}", engines[e].id, region),
          {.experiment = experiment.name, .engine = engines[e].id, .region = static_cast<int>(region)});
  const HostTable hosts = DealRobots(experiment, request->controller_hosts);
  plan.controlled_robots = hosts.of_robots.size();
  for (unsigned host = 0; host < hosts.hosts; ++host)
    Add(plan, ProcessRole::kControllerHost, HostName(host), std::to_string(host),
        {.experiment = experiment.name, .host = host, .threads = std::max(request->threads, 1U)});
  if (request->visualisations)
    for (const RenderConfiguration& render : experiment.visualisations)
      Add(plan, ProcessRole::kVisualiser, VisualiserName(render), render.id,
          {.experiment = experiment.name, .render = render.id, .output = request->output_folder});

  using enum ProcessRole;
  for (const ProcessRole role : {kSpaceServer, kEngine, kRegion, kControllerHost, kVisualiser})
    if (role != kVisualiser || request->visualisations) RefuseUnknownIds(plan, role);

  plan.robots = static_cast<std::size_t>(std::ranges::count_if(
      experiment.entities, [](const EntityConfiguration& entity) { return IsRobot(entity.kind); }));
  plan.is_serial = request->threads <= 1 && experiment.ahead == 0 && engines.size() == 1 &&
                   RegionsOf(engines.front()) == 0 && engines.front().tree.GetInteger("threads", 0) <= 1;
  return plan;
}

bool SharesOneCore(const ClusterPlan& plan)
{
  if (plan.settings.placement != "auto") return plan.settings.placement == "one-core";
  // Over a network, work beside the tick always exists: all cores give a tenth more ticks with 10 robots.
  if (!plan.machines.AllHere()) return false;
  if (HostCount(plan) > kHostsForOneCore) return false;
  const bool in_turn = plan.is_serial && HostCount(plan) == 1;
  return plan.robots <= (in_turn ? kRobotsInTurnForOneCore : kRobotsForOneCore);
}

void SetControllerHosts(ClusterPlan& plan, const std::vector<std::string>& machines)
{
  const auto is_host = [](const PlannedProcess& process) { return process.role == ProcessRole::kControllerHost; };
  const auto first = std::ranges::find_if(plan.processes, is_host);
  const PlannedProcess model = *first;
  std::vector<PlannedProcess> hosts;
  for (unsigned host = 0; host < machines.size(); ++host)
  {
    PlannedProcess& process = hosts.emplace_back(model);
    process.name = HostName(host);
    process.id = std::to_string(host);
    process.machine = machines[host];
    process.log_path = LogPath(plan, process);
    process.worker.host = host;
  }
  const auto after = plan.processes.erase(first, std::find_if_not(first, plan.processes.end(), is_host));
  plan.processes.insert(after, hosts.begin(), hosts.end());
}

std::string NoteAboutControllerHosts(unsigned requested, std::size_t robots, std::size_t cores)
{
  constexpr std::size_t kHostsOfACore = 8;  // more hosts only wait for each other, and take minutes to find each other
  const std::size_t made = std::min<std::size_t>(requested, std::max<std::size_t>(robots, 1));
  if (made < requested)
    return fmt::format("note: --controller-hosts is {}, and {} robot{} a controller: {} controller host{} started",
                       requested, robots, robots == 1 ? " has" : "s have", made, made == 1 ? " is" : "s are");
  if (cores > 0 && made > kHostsOfACore * cores)
    return fmt::format("note: --controller-hosts is {}, and {} core{} there for them: fewer start and run faster",
                       requested, cores, cores == 1 ? " is" : "s are");
  return "";
}

ProcessCommand CommandOf(const ClusterPlan& plan, const ClusterStart& start, std::size_t process,
                         const Incarnation& incarnation)
{
  const PlannedProcess& planned = plan.processes[process];
  const bool is_server = planned.role == ProcessRole::kSpaceServer;
  ProcessCommand command{.name = planned.name, .environment = start.environment, .input = start.key};
  command.arguments.push_back(std::filesystem::path(start.program_folder) / RowOf(planned.role).program);
  Append(command.arguments, is_server ? ServerArguments(plan, incarnation) : WorkerArguments(planned, incarnation));
  Append(command.arguments, BusWords(plan.bus));
  Append(command.arguments, plan.machines.Options());
  // If the launcher dies, the processes here end in good order (CatchInterrupts).
  command.signal_at_our_end = SIGTERM;
  if (planned.role != ProcessRole::kVisualiser && SharesOneCore(plan)) command.cores = start.cores;
  return plan.machines.CommandOn(command, planned.machine);
}

}  // namespace swarmanoid
