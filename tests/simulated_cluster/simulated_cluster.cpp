#include "tests/simulated_cluster/simulated_cluster.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "common/errors/exit_codes.h"
#include "common/experiment/load_experiment.h"
#include "common/messages/assignment.h"
#include "common/run/server_status.h"
#include "controller_host/cluster/host_node.h"
#include "engine_worker/cluster/engine_node.h"
#include "simulation/simulator.h"
#include "space_server/cluster/server_program.h"
#include "tests/simulated_cluster/simulated_network.h"

namespace swarmanoid::test
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kBound = 600s;  // limit of virtual time
constexpr auto kFinish = 10s;  // for processes to end after the last tick
constexpr auto kOthers = 3s;   // until the cause of an end is known, if another process caused it
constexpr std::uint64_t kMostSteps = 400'000;
constexpr Duration kLease = 7s;                          // --lease and the silence after it
constexpr Duration kLocalLease = std::chrono::hours(1);  // the launcher sees which process died
const std::string kHere = "here";

std::string Content(const std::string& file)
{
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// A process that the launcher starts.
struct Member
{
  std::string name;
  std::string machine = kHere;
  WorkerSettings settings{};
  bool is_host = false;
  unsigned incarnation = 0;
  SimulatedProcess* process = nullptr;  // the newest one
};

class Cluster
{
public:
  Cluster(const Scene& scene, std::uint64_t seed, std::string folder, const Trace& trace)
      : scene_(scene),
        folder_(std::move(folder)),
        trace_(trace),
        simulation_(seed),
        faults_(DrawFaults(seed)),
        network_(simulation_, faults_, faults_.has_network ? kLease : kLocalLease)
  {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    simulation_.on_end = [this](SimulatedProcess& process) { Ended(process); };
    network_.on_send = [this](const SimulatedWriter& writer, const SimulatedReader& reader, const Sample& sample)
    {
      // A host that computes a field on the floor needs the robots that deposit, wherever they are.
      if (faults_.has_network && scene_.hosts > 1 && writer.topic == "SpaceState" &&
          scene_.experiment->floor_fields.empty())
        Trouble(reader.process->name + " hears the whole state over a network, instead of its part");
      if (trace_.messages.empty() || !writer.topic.starts_with(trace_.messages)) return;
      std::string text = fmt::format("{} of {} to {}", writer.topic, writer.process->name, reader.process->name);
      if (writer.qos.hot)
        text += fmt::format(", tick {}{}", sample.header.tick, sample.header.repeated ? ", repeated" : "");
      if (writer.topic.starts_with("Region"))
      {
        // All three kinds are RegionMessages.
        const auto& message = *static_cast<const RegionMessage*>(sample.message.get());
        text += fmt::format(", epoch {}, number {}", message.epoch, message.number);
      }
      Say(text);
    };
    MakeMembers();
    DrawEvents();
  }

  ~Cluster()
  {
    simulation_.on_end = nullptr;
    status_ = nullptr;
    for (const auto& process : simulation_.Processes()) simulation_.Kill(*process);
  }

  ScheduleResult Run()
  {
    for (std::size_t k = 0; k < members_.size(); ++k) StartMember(k);
    Look();
    const RunTime start = simulation_.Now();
    while (!IsOver() && result_.trouble.empty())
    {
      while (!pending_.empty() && pending_.front().first <= simulation_.Steps())
      {
        const auto event = std::move(pending_.front().second);
        pending_.pop_front();
        event();
      }
      if (!simulation_.Step())
        Trouble("nothing can happen any more");
      else if (simulation_.Now() - start > kBound)
        Trouble("the run takes too long: somebody waits for ever");
      else if (simulation_.Steps() > kMostSteps)
        Trouble("the run takes too many steps");
    }
    result_.steps = simulation_.Steps();
    result_.virtual_s = std::chrono::duration<double>(simulation_.Now() - start).count();
    if (result_.trouble.empty()) CheckResult();
    if (!result_.trouble.empty()) result_.trouble += WhoIsThere();
    return result_;
  }

private:
  NetworkFaults DrawFaults(std::uint64_t seed)
  {
    SeededRandom& random = simulation_.Random();
    NetworkFaults faults;
    faults.has_network = random.Happens(0.5);
    constexpr double kFactors[] = {1, 1, 10, 100};
    faults.latency_factor = kFactors[random.Below(std::size(kFactors))];
    constexpr double kLosses[] = {0, 0.01, 0.1};
    faults.loss = kLosses[random.Below(std::size(kLosses))];
    faults.duplicates = random.Happens(0.5) ? 0.05 : 0;
    faults.lost_at_match = random.Happens(0.5) ? 0.05 : 0;
    faults.slow_copies = seed / 8 % 4 == 1 ? 0.1 : 0;  // without a draw, which would change other schedules
    return faults;
  }

  void MakeMembers()
  {
    const Experiment& experiment = *scene_.experiment;
    members_.push_back({"space server"});
    const auto add = [&](const std::string& name, const WorkerSettings& settings, bool is_host)
    {
      Member& member = members_.emplace_back();
      member.name = name;
      member.settings = settings;
      member.settings.experiment = experiment.name;
      member.is_host = is_host;
      if (faults_.has_network && simulation_.Random().Happens(0.5)) member.machine = "there";
      member.settings.machine = member.machine;
    };
    for (std::size_t e = 0; e < experiment.engines.size(); ++e)
    {
      add(EngineName(experiment, e), {.engine = experiment.engines[e].id}, false);
      for (unsigned region = 0; region < RegionsOf(experiment.engines[e]); ++region)
        add(RegionName(experiment, e, region), {.engine = experiment.engines[e].id, .region = static_cast<int>(region)},
            false);
    }
    for (unsigned host = 0; host < scene_.hosts; ++host) add(HostName(host), {.host = host}, true);
  }

  // Faults occur at steps, so that they hit each state of the processes, however short.
  void DrawEvents()
  {
    SeededRandom& random = simulation_.Random();
    const std::uint64_t count = random.Below(4);
    for (std::uint64_t k = 0; k < count; ++k)
    {
      const std::size_t victim = random.Below(members_.size());
      const std::uint64_t kind = random.Below(faults_.has_network ? 4 : 3);
      const Duration time = random.Happens(0.3) ? random.Between(1s, 12s) : random.Between(1ms, 1s);
      const std::uint64_t step = random.Below(kStepsOfRun);
      pending_.emplace_back(step,
                            [this, victim, kind, time]
                            {
                              if (kind == 3)
                                Cut(time);
                              else if (kind == 2)
                                Stop(members_[victim], time);
                              else
                                Kill(members_[victim]);
                            });
    }
    std::sort(pending_.begin(), pending_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  void Kill(Member& member)
  {
    if (member.process == nullptr || !member.process->is_alive || server_is_done_) return;
    Say("kills " + member.name);
    ++result_.kills;
    simulation_.Kill(*member.process);
  }

  void Stop(Member& member, Duration time)
  {
    if (member.process == nullptr || !member.process->is_alive) return;
    Say(fmt::format("stops {} for {:.3f} s", member.name, std::chrono::duration<double>(time).count()));
    ++result_.stops;
    simulation_.Stop(*member.process, time);
    network_.Stopped(*member.process, time);
  }

  void Cut(Duration time)
  {
    Say(fmt::format("cuts the network for {:.3f} s", std::chrono::duration<double>(time).count()));
    ++result_.cuts;
    network_.Cut("there", time);
  }

  BusOptions Bus() const
  {
    BusOptions bus;
    bus.insecure = true;
    if (faults_.has_network) bus.network_interface = "network";
    return bus;
  }

  void StartMember(std::size_t number)
  {
    simulation_.After(simulation_.Random().Between(1ms, 50ms),
                      [this, number, start = starts_]
                      {
                        Member& member = members_[number];
                        if (start != starts_) return;  // all processes have started again meanwhile
                        if (network_.IsCut(member.machine)) return StartMember(number);
                        Say(fmt::format("starts {}, incarnation {}", member.name, member.incarnation));
                        member.settings.incarnation = member.incarnation;
                        member.process = &simulation_.Start(
                            member.name, member.machine,
                            [this, number] { return number == 0 ? ServerMain() : WorkerMain(members_[number]); });
                      });
  }

  int WorkerMain(const Member& member)
  {
    try
    {
      const WorkerSettings settings = member.settings;
      return member.is_host ? RunControllerHost(settings, Bus()) : RunEngineWorker(settings, Bus());
    }
    catch (const std::exception& error)
    {
      Say(fmt::format("{} fails: {}", member.name, error.what()));
      errors_.push_back(fmt::format("{}: {}", member.name, error.what()));
      return kExitProcessFailed;
    }
  }

  int ServerMain()
  {
    ServerOptions options;
    options.file = scene_.name + ".xml";
    options.output_folder = folder_;
    options.hash_log = folder_ + "/hashes";
    options.visualisations = false;
    options.controller_hosts = scene_.hosts;
    options.awaits_replacements = true;
    options.goes_on_after_s = starts_ > 0 ? 1 : -1;
    options.bus = Bus();
    StatusFile status;
    status_ = &status;
    try
    {
      StatusChannel channel(status.descriptor);
      ServerProgram program(options, *scene_.experiment, channel);
      const int code = program.Run();
      ReadStatus();
      if (program.Failed()) EndAtOnce(code);
      return code;
    }
    catch (const std::exception& error)
    {
      errors_.push_back(fmt::format("space server: {}", error.what()));
      return kExitProcessFailed;
    }
  }

  // Reads the status lines of a space server.
  struct StatusFile
  {
    StatusFile() : descriptor(memfd_create("status", 0)) {}
    ~StatusFile() { close(descriptor); }
    int descriptor;
    off_t read = 0;
    std::string rest{};
  };

  void ReadStatus()
  {
    if (status_ == nullptr) return;
    char bytes[4096];
    for (ssize_t count = 0; (count = pread(status_->descriptor, bytes, sizeof(bytes), status_->read)) > 0;
         status_->read += count)
      status_->rest.append(bytes, static_cast<std::size_t>(count));
    for (std::size_t end = 0; (end = status_->rest.find('\n')) != std::string::npos;)
    {
      const std::string line = status_->rest.substr(0, end);
      status_->rest.erase(0, end + 1);
      if (!line.starts_with("tick ")) Say("space server says " + line);
      if (const auto status = ParseServerStatus(line)) Take(*status);
    }
  }

  void Take(const ServerStatus& status)
  {
    if (const auto* lost = std::get_if<ServerLost>(&status)) KillLost(lost->text);
    if (const auto* left = std::get_if<ServerLeft>(&status)) left_.insert(left->text);
    if (const auto* error = std::get_if<ServerError>(&status)) errors_.push_back("space server: " + error->text);
    if (std::get_if<ServerFinished>(&status) == nullptr || server_is_done_) return;
    server_is_done_ = true;
    simulation_.After(kFinish, [this] { EndLateReplacements(); });
  }

  // The launcher ends a replacement for a process whose Leave has been read. No server tells the replacement of the
  // end.
  void EndLateReplacements()
  {
    for (const Member& member : members_)
      if (member.process != nullptr && member.process->is_alive && left_.contains(member.name))
        simulation_.Kill(*member.process);
  }

  void KillLost(const std::string& name)
  {
    for (Member& member : members_)
    {
      if (member.name != name || member.process == nullptr || member.settings.incarnation != member.incarnation)
        continue;
      lost_.insert(name);
      if (member.process->is_alive)
        simulation_.After(1ms, [this, process = member.process] { simulation_.Kill(*process); });
      else
        Ended(*member.process);
    }
  }

  // The launcher reads the status lines all the time.
  void Look()
  {
    ReadStatus();
    simulation_.After(5ms, [this] { Look(); });
  }

  void Ended(SimulatedProcess& process)
  {
    network_.Died(process);
    const auto member = std::find_if(members_.begin(), members_.end(),
                                     [&](const Member& candidate) { return candidate.process == &process; });
    Say(fmt::format("{} ends {}", process.name,
                    process.exit_code ? fmt::format("with {}", *process.exit_code) : std::string("by a signal")));
    if (&process == members_.front().process) status_ = nullptr;
    if (member == members_.end() || restarts_) return;
    // The server waits for the good-bye of a process that it lost.
    const bool was_unheard = lost_.erase(member->name) > 0 && process.exit_code == kExitDone;
    if ((process.exit_code == kExitDone && !was_unheard) || (server_is_done_ && member != members_.begin())) return;
    if (member == members_.begin())
    {
      if (!process.exit_code || process.exit_code == kExitStuck) return Restart();
      return Trouble(fmt::format("the space server ends with {}", *process.exit_code));
    }
    if (left_.contains(member->name)) return;
    if (members_.front().process != nullptr && !members_.front().process->is_alive) return;
    const std::string text =
        process.exit_code ? fmt::format("{} ends with {}", process.name, *process.exit_code) : std::string();
    // The launcher waits for the cause of such an end. A replacement may end so because the space server has read the
    // Leave of its predecessor, and is about to tell the launcher.
    if (process.exit_code == kExitOthersFailed && member->incarnation > 0)
      return simulation_.After(kOthers,
                               [this, text, name = member->name]
                               {
                                 if (!left_.contains(name) && !server_is_done_) Trouble(text);
                               });
    if (process.exit_code && process.exit_code != kExitCutOff && !was_unheard) return Trouble(text);
    ++result_.replaced;
    ++member->incarnation;
    StartMember(static_cast<std::size_t>(member - members_.begin()));
  }

  // Kills all processes. They start again at the end of the journal.
  void Restart()
  {
    Say("starts all again");
    ++result_.restarts;
    ++starts_;
    restarts_ = true;
    left_.clear();
    lost_.clear();
    simulation_.After(0ms,
                      [this]
                      {
                        unsigned incarnation = 0;
                        for (Member& member : members_) incarnation = std::max(incarnation, member.incarnation + 1);
                        for (const auto& process : simulation_.Processes()) simulation_.Kill(*process);
                        restarts_ = false;
                        for (std::size_t k = 0; k < members_.size(); ++k)
                        {
                          members_[k].incarnation = incarnation;
                          members_[k].process = nullptr;
                          StartMember(k);
                        }
                      });
  }

  bool IsOver() const
  {
    return server_is_done_ &&
           std::none_of(members_.begin(), members_.end(),
                        [](const Member& member) { return member.process != nullptr && member.process->is_alive; });
  }

  void CheckResult()
  {
    const std::string hashes = Content(folder_ + "/hashes");
    if (hashes == scene_.hashes) return;
    std::istringstream own(hashes), wanted(scene_.hashes);
    std::string line, wanted_line;
    do {
      if (!std::getline(own, line)) line = "nothing";
      if (!std::getline(wanted, wanted_line)) wanted_line = "nothing";
    } while (line == wanted_line);
    Trouble(fmt::format("the hash log has '{}', one process has '{}'", line, wanted_line));
  }

  void Trouble(const std::string& text)
  {
    if (result_.trouble.empty()) result_.trouble = text;
  }

  std::string WhoIsThere() const
  {
    std::string text = fmt::format("\n  at {:.3f} s, step {}", result_.virtual_s, simulation_.Steps());
    for (const Member& member : members_)
      text += fmt::format("\n  {}: {}", member.name,
                          member.process == nullptr    ? "is not there"
                          : member.process->is_alive   ? "runs"
                          : !member.process->exit_code ? "was killed"
                                                       : fmt::format("ended with {}", *member.process->exit_code));
    for (const std::string& error : errors_) text += "\n  " + error;
    return text;
  }

  void Say(const std::string& text)
  {
    if (!trace_.events) return;
    fmt::print(stderr, "{:10.4f} s, step {:6}: {}\n",
               std::chrono::duration<double>(simulation_.Now().time_since_epoch()).count() - 3600, simulation_.Steps(),
               text);
  }

  static constexpr std::uint64_t kStepsOfRun = 4000;

  const Scene& scene_;
  const std::string folder_;
  const test::Trace trace_;
  ScheduleResult result_;
  std::vector<Member> members_;  // the space server is the first one
  std::deque<std::pair<std::uint64_t, std::function<void()>>> pending_;
  std::set<std::string> left_, lost_;
  std::vector<std::string> errors_;
  StatusFile* status_ = nullptr;
  unsigned starts_ = 0;  // counts the starts of all processes together
  bool restarts_ = false;
  bool server_is_done_ = false;
  Simulation simulation_;
  NetworkFaults faults_;
  SimulatedNetwork network_;
};

}  // namespace

Scene MakeScene(const std::string& name, const std::string& text, unsigned hosts, const std::string& folder)
{
  Scene scene;
  scene.name = name;
  scene.text = text;
  scene.hosts = hosts;
  LoadedExperiment loaded = LoadExperimentText(text, name + ".xml", ".");
  if (!loaded.experiment) throw std::runtime_error(loaded.errors.front().Text());
  scene.experiment = std::move(loaded.experiment);
  std::filesystem::create_directories(folder);
  SimulatorOptions options;
  options.hash_log = folder + "/hashes";
  options.visualisations = false;
  options.output_folder = folder;
  {
    CSimulator simulator(*scene.experiment, options);
    while (simulator.Step())
    {
    }
    simulator.Finish();
  }
  scene.hashes = Content(options.hash_log);
  return scene;
}

ScheduleResult RunSchedule(const Scene& scene, std::uint64_t seed, const std::string& folder, const Trace& trace)
{
  ScheduleResult result;
  {
    Cluster cluster(scene, seed, folder, trace);
    result = cluster.Run();
  }
  std::filesystem::remove_all(folder);
  return result;
}

}  // namespace swarmanoid::test
