#include "launcher/supervision/cluster_plan.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "common/bus/membership/cluster_options.h"
#include "common/bus/membership/worker_world.h"
#include "common/configuration/wording.h"
#include "launcher/command/sub_command.h"
#include "launcher/installation.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// Up to here the wake-ups across cores cost more than the work that they let run side by side (10 robots: 51 us a tick
// on one core, 70 us on two).
constexpr std::size_t kRobotsForOneCore = 300;
// The same where the processes work one after the other: what they say to one another stays in the core's cache (300
// robots: 1.37 times as fast on one core as on two, 1,000: 1.2, 2,000: 1.15, 4,000: as fast).
constexpr std::size_t kRobotsInTurnForOneCore = 3000;

// The name of a log; ids may hold anything.
std::string LogName(const std::string& program, const std::string& which)
{
  std::string name = which.empty() ? program : program + "-" + which;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.') c = '_';
  return name + ".log";
}

std::size_t Robots(const Experiment& experiment)
{
  return static_cast<std::size_t>(std::count_if(experiment.entities.begin(), experiment.entities.end(),
                                                [](const EntityConfiguration& entity)
                                                { return IsRobot(entity.kind); }));
}

// Whether no two processes of a tick have something to do at once.
bool WorkInTurn(const RunSettings& options, const Experiment& experiment, const Assignment& assignment)
{
  return assignment.hosts.size() == 1 && options.threads <= 1 && experiment.ahead == 0 &&
         experiment.engines.size() == 1 && RegionsOf(experiment.engines.front()) == 0 &&
         experiment.engines.front().tree.GetInteger("threads", 0) <= 1;
}

// Over a network there is always something to do beside the tick: a tenth more ticks with 10 robots on all cores.
bool AreBestOnOneCore(const RunSettings& options, const Experiment& experiment, const Assignment& assignment,
                      const Hosts& hosts)
{
  const bool in_turn = WorkInTurn(options, experiment, assignment);
  return hosts.AllHere() && Robots(experiment) <= (in_turn ? kRobotsInTurnForOneCore : kRobotsForOneCore);
}

// Counts the runs of this machine whose processes share one core, by that core.
std::map<int, std::size_t> RunsByCore()
{
  std::map<int, std::size_t> runs;
  std::error_code error;
  for (fs::directory_iterator process("/proc", error), end; !error && process != end; process.increment(error))
  {
    const pid_t pid = std::atoi(process->path().filename().c_str());
    std::string program;  // empty for a process that has ended and was not awaited
    cpu_set_t cores;
    if (pid <= 0 || !std::getline(std::ifstream(process->path() / "cmdline"), program, '\0') ||
        fs::path(program).filename() != "space_server" || sched_getaffinity(pid, sizeof cores, &cores) != 0 ||
        CPU_COUNT(&cores) != 1)
      continue;
    int core = 0;
    while (!CPU_ISSET(core, &cores)) ++core;
    ++runs[core];
  }
  return runs;
}

// Runs side by side take different cores. Two of them on one core starve one another while others are idle.
std::vector<int> CoresOf(const RunSettings& options, const Experiment& experiment, const Assignment& assignment,
                         const Hosts& hosts, int domain)
{
  const bool one = options.placement == "one-core" ||
                   (options.placement == "auto" && AreBestOnOneCore(options, experiment, assignment, hosts));
  std::vector<int> cores = AvailableCores();
  if (!one || cores.empty()) return {};
  // Runs that start together do not see one another, but they have different domains.
  std::rotate(cores.begin(), cores.begin() + domain % static_cast<std::ptrdiff_t>(cores.size()), cores.end());
  std::map<int, std::size_t> runs = RunsByCore();
  return {*std::ranges::min_element(cores, {}, [&](int core) { return runs[core]; })};
}

void RefuseUnknown(const Hosts& hosts, const std::string& role, const std::vector<std::string>& known)
{
  for (const std::string& name : hosts.Named(role))
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(fmt::format("a host is given for {} {}, which the experiment does not have; it has {}{}", role,
                                   Quoted(name), Listed(known), DidYouMean(name, known)));
}

// Makes the command lines of the processes of a run.
struct CommandMaker
{
  ProcessCommand Make(const std::string& name, const std::string& program, const std::string& host,
                      const std::vector<std::string>& arguments) const
  {
    ProcessCommand command;
    command.name = name;
    command.arguments.push_back(fs::path(ProgramFolder()) / program);
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    const std::vector<std::string> bus_words = BusWords(bus);
    command.arguments.insert(command.arguments.end(), bus_words.begin(), bus_words.end());
    command.arguments.insert(command.arguments.end(), hosts.Options().begin(), hosts.Options().end());
    command.environment = EnvironmentOf(limits);
    command.input = key;
    // If the launcher dies, the processes here end in good order (CatchInterrupts).
    command.signal_at_our_end = SIGTERM;
    ProcessCommand placed = hosts.Placed(command, host);
    placed.cores = cores;
    return placed;
  }

  Hosts hosts;
  BusOptions bus;
  Limits limits;
  std::vector<int> cores;
  std::string key;  // what a process is told when it asks for it
};

// What the file of --hosts calls a region: "ground/2".
std::string RegionPlace(const EngineConfiguration& engine, unsigned region)
{
  return fmt::format("{}/{}", engine.id, region);
}

// As users call it.
std::string PlaceName(const std::string& host) { return host.empty() ? kHere : host; }

void AddPlace(std::vector<std::string>& words, const std::string& worker, const std::string& host)
{
  words.insert(words.end(), {"--place", worker + "=" + PlaceName(host)});
}

// Which robots' controllers may fail, while the run goes on.
std::function<bool(std::uint32_t)> MayFailOf(const Experiment& experiment)
{
  std::vector<bool> may_fail;
  for (const EntityConfiguration& entity : experiment.entities)
  {
    const ControllerConfiguration* controller = experiment.FindController(entity.controller);
    may_fail.push_back(controller != nullptr && controller->MayFail());
  }
  return [may_fail = std::move(may_fail)](std::uint32_t robot) { return robot < may_fail.size() && may_fail[robot]; };
}

class Planner
{
public:
  Planner(const Experiment& experiment, const RunFolder& folder, CommandMaker maker)
      : experiment_(experiment), folder_(folder), maker_(std::move(maker))
  {
  }

  MemberPlan& Add(const std::string& name, const std::string& program, const std::string& role,
                  const std::string& which, const std::vector<std::string>& arguments)
  {
    MemberPlan plan;
    plan.host = maker_.hosts.HostOf(role, which);
    plan.command = maker_.Make(name, program, plan.host, arguments);
    plan.log_path = folder_.File(LogName(program, which));
    plans_.push_back(plan);
    return plans_.back();
  }

  // The same for a process that finds its experiment by name, and can be replaced.
  MemberPlan& AddWorker(const std::string& name, const std::string& program, const std::string& role,
                        const std::string& which, WorkerTable table, WorkerSettings settings)
  {
    settings.experiment = experiment_.name;
    settings.machine = PlaceName(maker_.hosts.HostOf(role, which));
    MemberPlan& plan = Add(name, program, role, which, WorkerWords(table, settings));
    const auto where = std::make_shared<std::string>(plan.host);
    (*places_)[name] = where;
    plan.place = [where](const std::string& host) { *where = host; };
    plan.replacement = [maker = maker_, name, program, where, table, settings](
                           unsigned incarnation, double, const std::vector<ControllerDeath>& deaths)
    {
      WorkerSettings next = settings;
      next.incarnation = incarnation;
      next.machine = PlaceName(*where);
      for (const ControllerDeath& death : deaths) next.faults.push_back(fmt::format("{}:{}", death.tick, death.robot));
      return maker.Make(name, program, *where, WorkerWords(table, next));
    };
    return plan;
  }

  std::vector<MemberPlan> Take() { return std::move(plans_); }

  // Where each worker is, or is to be next: shared by those who start them.
  using Places = std::map<std::string, std::shared_ptr<std::string>>;
  std::shared_ptr<const Places> WorkersPlaces() const { return places_; }

private:
  const Experiment& experiment_;
  const RunFolder& folder_;
  CommandMaker maker_;
  std::vector<MemberPlan> plans_;
  std::shared_ptr<Places> places_ = std::make_shared<Places>();
};

BusOptions BusOf(const RunSettings& options, const Hosts& hosts, int domain)
{
  // Deaths on this machine are seen from here, and a stopped process (a debugger's) is not dead.
  constexpr double kForEver_s = 3600;
  BusOptions bus;
  bus.domain = domain;
  if (hosts.AllHere()) bus.lease_s = kForEver_s;
  if (options.lease_s > 0) bus.lease_s = options.lease_s;
  bus.insecure = options.insecure;
  if (!options.insecure) bus.key_fd = STDIN_FILENO;
  return bus;
}

std::vector<std::string> ServerArguments(RunSettings settings, const Experiment& experiment,
                                         const Assignment& assignment, const Hosts& hosts, const RunFolder& folder)
{
  settings.controller_hosts = static_cast<unsigned>(assignment.hosts.size());
  settings.output_folder = folder.Path();
  std::vector<std::string> words = ServerWords(settings);
  words.insert(words.end(), {"--status-fd", "1"});
  if (!settings.Replaces()) return words;
  words.emplace_back("--await-replacements");
  // What users may ask to be moved, and where to.
  words.insert(words.end(), {"--machine", kHere});
  for (const std::string& machine : hosts.Machines()) words.insert(words.end(), {"--machine", machine});
  AddPlace(words, "space server", hosts.HostOf("space_server", ""));
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
    AddPlace(words, EngineName(experiment, e), hosts.HostOf("engine", experiment.engines[e].id));
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
    for (unsigned region = 0; region < RegionsOf(experiment.engines[e]); ++region)
      AddPlace(words, RegionName(experiment, e, region),
               hosts.HostOf("region", RegionPlace(experiment.engines[e], region)));
  for (std::size_t h = 0; h < assignment.hosts.size(); ++h)
    AddPlace(words, HostName(h), hosts.HostOf("controller_host", std::to_string(h)));
  if (!settings.visualisations) return words;
  for (const RenderConfiguration& render : experiment.visualisations)
    AddPlace(words, VisualiserName(render), hosts.HostOf("visualiser", render.id));
  return words;
}

}  // namespace

namespace
{

// The ids of those that each have a process.
struct WorkerIds
{
  WorkerIds(const RunSettings& options, const Experiment& experiment, const Assignment& assignment)
  {
    for (const EngineConfiguration& engine : experiment.engines)
    {
      engines.push_back(engine.id);
      for (unsigned region = 0; region < RegionsOf(engine); ++region) regions.push_back(RegionPlace(engine, region));
    }
    for (std::size_t host = 0; host < assignment.hosts.size(); ++host) controller_hosts.push_back(std::to_string(host));
    if (options.visualisations)
      for (const RenderConfiguration& render : experiment.visualisations) visualisers.push_back(render.id);
  }

  std::vector<std::string> engines, regions, controller_hosts, visualisers;
};

}  // namespace

void RequirePlaces(const RunSettings& options, const Experiment& experiment, const Assignment& assignment,
                   const Hosts& hosts)
{
  const WorkerIds ids(options, experiment, assignment);
  RefuseUnknown(hosts, "space_server", {});
  RefuseUnknown(hosts, "engine", ids.engines);
  RefuseUnknown(hosts, "region", ids.regions);
  RefuseUnknown(hosts, "controller_host", ids.controller_hosts);
  if (options.visualisations) RefuseUnknown(hosts, "visualiser", ids.visualisers);
}

std::vector<MemberPlan> PlanCluster(const RunSettings& options, const Experiment& experiment,
                                    const Assignment& assignment, const Hosts& hosts, const RunFolder& folder,
                                    int domain, const std::optional<RunKey>& key)
{
  const auto& [engines, regions, controller_hosts, visualisers] = WorkerIds(options, experiment, assignment);
  const std::vector<int> cores = CoresOf(options, experiment, assignment, hosts, domain);
  Planner planner(
      experiment, folder,
      {hosts, BusOf(options, hosts, domain), LimitsOf(options), cores, key ? TextOfKey(*key) + "\n" : std::string()});
  MemberPlan& server = planner.Add("space server", "space_server", "space_server", "",
                                   ServerArguments(options, experiment, assignment, hosts, folder));
  server.output = MemberPlan::kStatus;
  // On another machine, the one before may live on unseen.
  if (options.Replaces() && server.host.empty())
    server.replacement = [command = server.command, places = planner.WorkersPlaces()](
                             unsigned, double taken_s, const std::vector<ControllerDeath>&)
    {
      ProcessCommand next = command;
      for (const auto& [worker, host] : *places) AddPlace(next.arguments, worker, *host);
      next.arguments.insert(next.arguments.end(), {"--go-on", fmt::format("{}", taken_s)});
      return next;
    };
  for (std::size_t e = 0; e < engines.size(); ++e)
    planner.AddWorker(EngineName(experiment, e), "engine_worker", "engine", engines[e], EngineOptionTable,
                      {.engine = engines[e]});
  for (std::size_t e = 0; e < engines.size(); ++e)
    for (unsigned region = 0; region < RegionsOf(experiment.engines[e]); ++region)
      planner.AddWorker(RegionName(experiment, e, region), "engine_worker", "region",
                        RegionPlace(experiment.engines[e], region), EngineOptionTable,
                        {.engine = engines[e], .region = static_cast<int>(region)});
  for (std::size_t host = 0; host < controller_hosts.size(); ++host)
    planner
        .AddWorker(HostName(host), "controller_host", "controller_host", controller_hosts[host], HostOptionTable,
                   {.host = static_cast<unsigned>(host), .threads = std::max(options.threads, 1U)})
        .may_fail = MayFailOf(experiment);
  for (std::size_t v = 0; v < visualisers.size(); ++v)
  {
    MemberPlan& plan =
        planner.AddWorker(VisualiserName(experiment.visualisations[v]), "visualiser", "visualiser", visualisers[v],
                          VisualiserOptionTable, {.render = visualisers[v], .output = folder.Path()});
    plan.output = MemberPlan::kScreen;
    plan.visualiser = true;
    plan.command.cores.clear();
  }
  return planner.Take();
}

std::string NoteAboutControllerHosts(unsigned asked, std::size_t robots, std::size_t cores)
{
  constexpr std::size_t kHostsOfACore = 8;  // more only wait for each other, and take minutes to find each other
  const std::size_t made = std::min<std::size_t>(asked, std::max<std::size_t>(robots, 1));
  if (made < asked)
    return fmt::format("note: --controller-hosts is {}, and {} robot{} a controller: {} controller host{} started",
                       asked, robots, robots == 1 ? " has" : "s have", made, made == 1 ? " is" : "s are");
  if (cores > 0 && made > kHostsOfACore * cores)
    return fmt::format("note: --controller-hosts is {}, and {} core{} there for them: fewer start and run faster",
                       asked, cores, cores == 1 ? " is" : "s are");
  return "";
}

}  // namespace swarmanoid
