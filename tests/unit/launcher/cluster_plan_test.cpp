// The processes of a run, as they follow from the request and the experiment.
#include "launcher/supervision/cluster_plan.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "common/program/usage_error.h"
#include "common/run/run_options.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

// `robots` footbots with controllers in a row, on one engine for each of the tags.
Experiment Swarm(std::size_t robots, const std::vector<std::string>& engines = {"kinematics2d"})
{
  Experiment experiment;
  experiment.name = "swarm";
  experiment.controllers.emplace_back().id = "c";
  for (const std::string& tag : engines)
  {
    EngineConfiguration& engine = experiment.engines.emplace_back();
    engine.tag = tag;
    engine.id = "the_" + tag;
  }
  for (std::size_t k = 0; k < robots; ++k)
  {
    EntityConfiguration& entity = experiment.entities.emplace_back();
    entity.kind = EntityKind::kFootbot;
    entity.controller = "c";
    entity.movable = true;
    entity.pose.position.x() = static_cast<double>(k);
    experiment.engines[k % engines.size()].entities.push_back(static_cast<std::uint32_t>(k));
  }
  return experiment;
}

RunSettings Settings()
{
  RunSettings settings;
  settings.file = "/swarm.xml";
  settings.output_folder = "/run";
  settings.domain = 7;
  return settings;
}

// It makes a file for --hosts, which is removed with the object.
class HostsFile
{
public:
  explicit HostsFile(const std::string& text)
      : path_(testing::TempDir() + "swarmanoid_hosts_" + std::to_string(getpid()))
  {
    std::ofstream(path_) << text;
  }
  ~HostsFile() { std::remove(path_.c_str()); }
  const std::string& Path() const { return path_; }
  RunRequest Request(RunSettings settings = Settings()) const
  {
    settings.hosts_file = path_;
    return RunRequest(settings);
  }

private:
  std::string path_;
};

std::vector<std::string> NamesOf(const ClusterPlan& plan)
{
  std::vector<std::string> names;
  for (const PlannedProcess& process : plan.processes) names.push_back(process.name);
  return names;
}

const PlannedProcess& Find(const ClusterPlan& plan, const std::string& name)
{
  return *std::ranges::find(plan.processes, name, &PlannedProcess::name);
}

std::string LineOf(const ClusterPlan& plan, const std::string& name, const Incarnation& incarnation = {})
{
  const auto process = static_cast<std::size_t>(&Find(plan, name) - plan.processes.data());
  const ClusterStart start{.program_folder = "/bin", .environment = {}, .cores = {3}, .key = "the key\n"};
  const ProcessCommand command = CommandOf(plan, start, process, incarnation);
  EXPECT_EQ(command.input, "the key\n");
  std::string line;
  for (const std::string& word : command.arguments) line += (line.empty() ? "" : " ") + word;
  return line;
}

TEST(ClusterPlan, WithoutRobotsThereIsOneControllerHost)
{
  const ClusterPlan plan = MakePlan(RunRequest(Settings()), Swarm(0));
  EXPECT_THAT(NamesOf(plan), ElementsAre("space server", "engine 'the_kinematics2d'", "controller host 0"));
  EXPECT_EQ(plan.controlled_robots, 0U);
}

TEST(ClusterPlan, OneRobotTakesThreeProcessesOnOneCoreOfThisMachine)
{
  const ClusterPlan plan = MakePlan(RunRequest(Settings()), Swarm(1));
  EXPECT_THAT(NamesOf(plan), ElementsAre("space server", "engine 'the_kinematics2d'", "controller host 0"));
  for (const PlannedProcess& process : plan.processes) EXPECT_TRUE(process.IsHere()) << process.name;
  EXPECT_TRUE(SharesOneCore(plan));
  EXPECT_EQ(Find(plan, "space server").log_path, "/run/space_server.log");
  EXPECT_EQ(Find(plan, "controller host 0").log_path, "/run/controller_host-0.log");
  EXPECT_EQ(
      LineOf(plan, "space server"),
      "/bin/space_server /swarm.xml --output /run --status-fd 1 --await-replacements --machine here --place space "
      "server=here --place engine 'the_kinematics2d'=here --place controller host 0=here --domain 7 --lease 3600 "
      "--key-fd 0");
  EXPECT_EQ(LineOf(plan, "engine 'the_kinematics2d'"),
            "/bin/engine_worker --engine the_kinematics2d --experiment swarm --machine here --domain 7 --lease 3600 "
            "--key-fd 0");
  EXPECT_EQ(LineOf(plan, "controller host 0"),
            "/bin/controller_host --experiment swarm --machine here --domain 7 --lease 3600 --key-fd 0");
}

TEST(ClusterPlan, EachEngineHasAWorker)
{
  const ClusterPlan plan = MakePlan(RunRequest(Settings()), Swarm(3, {"kinematics2d", "dynamics2d", "dynamics3d"}));
  EXPECT_THAT(NamesOf(plan), ElementsAre("space server", "engine 'the_kinematics2d'", "engine 'the_dynamics2d'",
                                         "engine 'the_dynamics3d'", "controller host 0"));
}

TEST(ClusterPlan, ASplitEngineHasAProcessForEachRegion)
{
  Experiment experiment = Swarm(3);
  experiment.engines[0].split.regions = 2;
  const ClusterPlan plan = MakePlan(RunRequest(Settings()), experiment);
  EXPECT_THAT(NamesOf(plan),
              ElementsAre("space server", "engine 'the_kinematics2d'", "region 0 of engine 'the_kinematics2d'",
                          "region 1 of engine 'the_kinematics2d'", "controller host 0"));
  EXPECT_THAT(LineOf(plan, "region 1 of engine 'the_kinematics2d'"), HasSubstr("--engine the_kinematics2d --region 1"));
}

TEST(ClusterPlan, ControllerHostsAreNeverMoreThanRobots)
{
  RunSettings settings = Settings();
  settings.controller_hosts = 5;
  settings.threads = 2;
  const ClusterPlan plan = MakePlan(RunRequest(settings), Swarm(3));
  EXPECT_THAT(NamesOf(plan), ElementsAre("space server", "engine 'the_kinematics2d'", "controller host 0",
                                         "controller host 1", "controller host 2"));
  EXPECT_THAT(LineOf(plan, "space server"), HasSubstr("--controller-hosts 3"));
  EXPECT_THAT(LineOf(plan, "controller host 2"), HasSubstr("--host 2 --threads 2"));
}

TEST(ClusterPlan, VisualisersAreLeftOutOnRequestAndKeepAllCores)
{
  Experiment experiment = Swarm(1);
  experiment.visualisations.emplace_back().id = "text";
  experiment.visualisations.back().tag = "text_render";
  const ClusterPlan plan = MakePlan(RunRequest(Settings()), experiment);
  const ClusterStart start{.program_folder = "/bin", .environment = {}, .cores = {3}, .key = ""};
  EXPECT_THAT(LineOf(plan, "visualiser 'text'"),
              HasSubstr("--render text --machine here --experiment swarm --output /run"));
  EXPECT_TRUE(CommandOf(plan, start, 3).cores.empty());
  EXPECT_THAT(CommandOf(plan, start, 1).cores, ElementsAre(3));
  RunSettings settings = Settings();
  settings.visualisations = false;
  EXPECT_EQ(MakePlan(RunRequest(settings), experiment).processes.size(), 3U);
}

TEST(ClusterPlan, TheFileOfHostsNamesMachinesAndReserve)
{
  const HostsFile file("engine = alpha\ncontroller_host 1 = beta\nmachines = gamma\noptions = --interface eth0\n");
  RunSettings settings = Settings();
  settings.controller_hosts = 2;
  const ClusterPlan plan = MakePlan(file.Request(settings), Swarm(2));
  EXPECT_EQ(Find(plan, "engine 'the_kinematics2d'").machine, "alpha");
  EXPECT_TRUE(Find(plan, "controller host 0").IsHere());
  EXPECT_EQ(Find(plan, "controller host 1").machine, "beta");
  EXPECT_THAT(LineOf(plan, "space server"), HasSubstr("--machine here --machine alpha --machine beta --machine gamma"));
  EXPECT_THAT(LineOf(plan, "space server"), HasSubstr("controller host 1=beta"));
  EXPECT_THAT(LineOf(plan, "space server"), HasSubstr("--domain 7 --key-fd 0 --interface eth0")) << "the usual lease";
  EXPECT_THAT(LineOf(plan, "controller host 1"),
              HasSubstr("ssh -tt -o BatchMode=yes -- beta env /bin/controller_host"));
  EXPECT_FALSE(SharesOneCore(plan));
}

TEST(ClusterPlan, SlurmStartsTheStepsOfAJob)
{
  const HostsFile file("command = srun --overlap --nodelist={host} {command}\nengine = node02\n");
  EXPECT_THAT(LineOf(MakePlan(file.Request(), Swarm(1)), "engine 'the_kinematics2d'"),
              HasSubstr("srun --overlap --nodelist=node02 env /bin/engine_worker --engine the_kinematics2d"));
}

TEST(ClusterPlan, MachinesForUnknownProcessesAreRefused)
{
  EXPECT_THAT([] { MakePlan(HostsFile("engine grund = alpha").Request(), Swarm(1)); },
              testing::ThrowsMessage<UsageError>("a host is given for engine 'grund', which the experiment does not "
                                                 "have; it has the_kinematics2d"));
  EXPECT_THROW(MakePlan(HostsFile("controller_host 1 = alpha").Request(), Swarm(2)), UsageError);
}

TEST(ClusterPlan, AServerOnAnotherMachineIsNotReplaced)
{
  EXPECT_TRUE(MakePlan(RunRequest(Settings()), Swarm(1)).processes.front().replaceable);
  EXPECT_FALSE(MakePlan(HostsFile("space_server = alpha").Request(), Swarm(1)).processes.front().replaceable);
  EXPECT_FALSE(MakePlan(RunRequest(Settings(), [](CSimulator&) {}), Swarm(1)).processes.front().replaceable);
}

TEST(ClusterPlan, ALaterIncarnationLearnsOfDeathsAndMoves)
{
  ClusterPlan plan = MakePlan(RunRequest(Settings()), Swarm(2));
  plan.processes[2].machine = "alpha";
  const Incarnation second{.number = 1, .taken_s = 2.5, .deaths = {{30, 1}}};
  EXPECT_THAT(LineOf(plan, "space server", second), HasSubstr("controller host 0=alpha --go-on 2.5"));
  EXPECT_THAT(LineOf(plan, "controller host 0", second), HasSubstr("--fault 30:1"));
  EXPECT_THAT(LineOf(plan, "controller host 0", second), HasSubstr("--incarnation 1 --machine alpha"));
}

TEST(ClusterPlan, UsersChangeTheNumberOfControllerHosts)
{
  Experiment experiment = Swarm(3);
  experiment.visualisations.emplace_back().id = "text";
  ClusterPlan plan = MakePlan(RunRequest(Settings()), experiment);
  SetControllerHosts(plan, {"beta", "here"});
  EXPECT_THAT(NamesOf(plan), ElementsAre("space server", "engine 'the_kinematics2d'", "controller host 0",
                                         "controller host 1", "visualiser 'text'"));
  EXPECT_EQ(Find(plan, "controller host 0").machine, "beta");
  EXPECT_EQ(Find(plan, "controller host 1").log_path, "/run/controller_host-1.log");
  EXPECT_THAT(LineOf(plan, "space server"), HasSubstr("--controller-hosts 2"));
  SetControllerHosts(plan, {"here"});
  EXPECT_EQ(plan.processes.size(), 4U);
}

TEST(ClusterPlan, ManyRobotsTakeAllCores)
{
  RunSettings settings = Settings();
  EXPECT_TRUE(SharesOneCore(MakePlan(RunRequest(settings), Swarm(3000))));
  EXPECT_FALSE(SharesOneCore(MakePlan(RunRequest(settings), Swarm(3001))));
  settings.controller_hosts = 2;
  EXPECT_TRUE(SharesOneCore(MakePlan(RunRequest(settings), Swarm(300))));
  EXPECT_FALSE(SharesOneCore(MakePlan(RunRequest(settings), Swarm(301))));
  settings.placement = "one-core";
  EXPECT_TRUE(SharesOneCore(MakePlan(RunRequest(settings), Swarm(301))));
}

TEST(ClusterPlan, AnIsolatedRunCanReachNobody)
{
  RunSettings settings = Settings();
  settings.isolated = true;
  Experiment experiment = Swarm(1);
  experiment.visualisations.emplace_back().id = "page";
  experiment.visualisations.back().tag = "web_render";
  EXPECT_THAT([&] { MakePlan(RunRequest(settings), experiment); },
              testing::ThrowsMessage<UsageError>(HasSubstr("--isolated: no browser could reach the page of")));
}

TEST(ControllerHosts, MoreThanPayAreNoted)
{
  EXPECT_EQ(NoteAboutControllerHosts(1000, 10, 2),
            "note: --controller-hosts is 1000, and 10 robots have a controller: 10 controller hosts are started");
  EXPECT_EQ(NoteAboutControllerHosts(2, 1, 2),
            "note: --controller-hosts is 2, and 1 robot has a controller: 1 controller host is started");
  EXPECT_EQ(NoteAboutControllerHosts(17, 1000, 2),
            "note: --controller-hosts is 17, and 2 cores are there for them: fewer start and run faster");
  EXPECT_EQ(NoteAboutControllerHosts(16, 1000, 2), "");
  EXPECT_EQ(NoteAboutControllerHosts(17, 1000, 0), "") << "other machines have cores, too";
  EXPECT_EQ(NoteAboutControllerHosts(1, 0, 2), "") << "one host is always there";
}

// The table has each pair of options that contradict each other, and the error for it.
TEST(RunRequest, ContradictionsAreRefusedWithTheCure)
{
  const auto error_of = [](const std::function<void(RunSettings&)>& change, const WatchFunction& watch = {})
  {
    RunSettings settings;
    settings.file = "a.xml";
    change(settings);
    try
    {
      RunRequest(settings, watch);
    }
    catch (const UsageError& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(error_of([](RunSettings&) {}), "");
  EXPECT_EQ(error_of([](RunSettings& s) { s.file.clear(); }),
            "name an experiment file, or a run to branch off with --branch RUN@TICK");
  EXPECT_EQ(error_of([](RunSettings& s) { s.any_build = true; }),
            "--any-build is about a checkpoint; name it with --restore");
  EXPECT_EQ(error_of([](RunSettings& s) { s.any_build = true, s.branch = "runs/first@5"; }), "");
  EXPECT_EQ(error_of([](RunSettings& s) { s.journal_budget = "2GiB", s.journal = false; }),
            "--journal-budget: the run keeps no journal; leave out --single-process and --no-journal");
  EXPECT_EQ(error_of([](RunSettings& s) { s.key_file = "k", s.insecure = true; }),
            "--key and --insecure: a run has a key, or lets anybody in; give one of them");
  EXPECT_EQ(error_of([](RunSettings& s) { s.seed = 1, s.settings = {"framework.seed=2"}; }),
            "--seed 1 and --set framework.seed=2 set the same value; leave one of the two out");
  EXPECT_EQ(error_of([](RunSettings& s) { s.branch = "a@5", s.restore_file = "c"; }),
            "--branch: a run begins with one state; leave out --restore");
  EXPECT_EQ(error_of([](RunSettings& s) { s.branch = "a@5", s.faults_of = "b"; }),
            "--branch: controllers fail as in the run that it is of; leave out --faults-of");
  const std::string cluster = "; leave out --single-process to run a cluster";
  EXPECT_EQ(error_of([](RunSettings& s) { s.single_process = true, s.controller_hosts = 2; }),
            "--controller-hosts: a single process has one" + cluster);
  EXPECT_EQ(error_of([](RunSettings& s) { s.single_process = true, s.engine_hosts = {"a=b"}; }),
            "--hosts and --engine-host: a single process runs on this machine" + cluster);
  EXPECT_EQ(error_of([](RunSettings& s) { s.single_process = true, s.domain = 1; }),
            "--domain: a single process uses no DDS" + cluster);
  EXPECT_EQ(error_of([](RunSettings& s) { s.single_process = true, s.key_file = "k"; }),
            "--key: a single process needs none" + cluster);
  EXPECT_EQ(error_of([](RunSettings& s) { s.isolated = true, s.engine_hosts = {"a=b"}; }),
            "--isolated: the run has processes on other machines");
  EXPECT_EQ(error_of([](RunSettings& s) { s.isolated = true; }, [](CSimulator&) {}),
            "--isolated: the space server is this process, which would lose its network");
  const HostsFile file("space_server = alpha");
  EXPECT_THAT(error_of([&](RunSettings& s) { s.hosts_file = file.Path(); }, [](CSimulator&) {}),
              HasSubstr("--hosts: the space server is this process"));
}

TEST(RunRequest, AChangedCopyLeavesTheRequestAsItWas)
{
  const RunRequest request(Settings());
  const RunRequest changed = request.With([](RunSettings& settings) { settings.seed = 9; });
  EXPECT_FALSE(request->seed);
  EXPECT_TRUE(request.Changes().settings.empty());
  EXPECT_EQ(changed.Changes().settings.size(), 1U);
}

}  // namespace
}  // namespace swarmanoid
