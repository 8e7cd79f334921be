#include "tests/cluster/cluster_fixture.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/bus/bus.h"
#include "common/bus/membership/control_client.h"
#include "common/experiment/load_experiment.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "simulation/single_process.h"
#include "test_folders.h"
#include "visualiser/render.h"

namespace swarmanoid
{

namespace fs = std::filesystem;

namespace
{

std::string SharedFolderOfTest()
{
  std::string folder = "/dev/shm/swarmanoid-test-" + std::to_string(getpid());
  setenv("SWARMANOID_SHARED_FOLDER", folder.c_str(), 1);
  return folder;
}

}  // namespace

ClusterTest::ClusterTest()
    : folder_((fs::temp_directory_path() / ("swarmanoid-cluster-" + std::to_string(getpid()))).string()),
      shared_folder_(SharedFolderOfTest())
{
  fs::create_directories(folder_);
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
}

ClusterTest::~ClusterTest()
{
  fs::remove_all(folder_);
  fs::remove_all(shared_folder_);
}

std::string ClusterTest::WriteExperiment(const std::string& name, int engines, int ticks,
                                         const std::string& visualisation)
{
  std::string robots;
  std::string engine_list;
  std::string physics;
  for (int e = 0; e < engines; ++e)
  {
    robots += fmt::format(
        "<distribute quantity='{}'><position method='uniform'/><orientation method='uniform'/>"
        "<footbot id='robots{}'><controller>diffusion</controller></footbot></distribute>\n",
        12 / engines, e);
    engine_list += fmt::format("<dummy_engine id='e{}'/>\n", e);
    physics += fmt::format("<engine id='e{0}'><entity id='wall_*'/><entity id='robots{0}_*'/></engine>\n", e);
  }
  std::string walls;
  const char* const places[] = {"0, 1.5, 0.25", "3, 1.5, 0.25", "1.5, 0, 0.25", "1.5, 3, 0.25"};
  for (int w = 0; w < 4; ++w)
    walls += fmt::format("<block id='wall_{}'><position>{}</position><size>{}</size></block>\n", w, places[w],
                         w < 2 ? "0.1, 3, 0.5" : "3, 0.1, 0.5");
  const std::string file = folder_ + "/" + name + ".xml";
  std::ofstream(file) << fmt::format(
      R"(<?xml version="1.0"?>
<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>{}</maxclock><controller_path>{}</controller_path></framework>
  <controllers>
    <footbot_diffusion id="diffusion" library="footbot_diffusion">
      <actuators>
        <footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>
        <footbot_leds><implementation>generic_footbot_leds</implementation></footbot_leds>
      </actuators>
      <sensors>
        <footbot_proximity><implementation>generic_footbot_proximity</implementation></footbot_proximity>
        <footbot_encoders><implementation>engine_footbot_encoders</implementation></footbot_encoders>
      </sensors>
      <parameters><velocity>0.1</velocity><alpha>7.5</alpha><delta>0.1</delta></parameters>
    </footbot_diffusion>
  </controllers>
  <arena size="3, 3, 1" optimization="2D">
{}{}  </arena>
  <engines>
{}  </engines>
  <arena_physics>
{}  </arena_physics>
  <visualisations>{}</visualisations>
</ahss-config>
)",
      ticks, SWARMANOID_BUILD_FOLDER "/lib/controllers", walls, robots, engine_list, physics, visualisation);
  return file;
}

ChildProcess ClusterTest::Start(const std::string& program, const std::vector<std::string>& options)
{
  std::vector<std::string> command{SWARMANOID_BUILD_FOLDER "/bin/" + program};
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"--domain", DomainText()});
  command.insert(command.end(), options_.begin(), options_.end());
  return {command, fmt::format("{}/{}_{}.log", folder_, program, started_++)};
}

ChildProcess ClusterTest::StartServer(const std::string& file, const std::vector<std::string>& options)
{
  std::vector<std::string> all{file};
  all.insert(all.end(), options.begin(), options.end());
  return Start("space_server", all);
}

ChildProcess ClusterTest::StartEngine(const std::string& experiment, int engine)
{
  return Start("engine_worker", {"--experiment", experiment, "--engine", fmt::format("e{}", engine)});
}

ChildProcess ClusterTest::StartHost(const std::string& experiment, int host)
{
  return Start("controller_host", {"--experiment", experiment, "--host", std::to_string(host)});
}

std::vector<ChildProcess> ClusterTest::StartWorkers(const std::string& experiment, int engines, int hosts)
{
  std::vector<ChildProcess> workers;
  for (int e = 0; e < engines; ++e) workers.push_back(StartEngine(experiment, e));
  for (int h = 0; h < hosts; ++h) workers.push_back(StartHost(experiment, h));
  return workers;
}

bool ClusterTest::Ask(const std::string& experiment, const std::string& verb) const
{
  BusOptions options;
  options.domain = domain_.Id();
  Bus bus(options, "test");
  const auto reply = ControlClient(bus, experiment).Ask({verb}, kGenerous_s);
  return reply && reply->ok;
}

std::string ClusterTest::Read(const std::string& file) const
{
  std::ifstream stream(folder_ + "/" + file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

bool ClusterTest::Reaches(std::ptrdiff_t ticks, const std::string& hash_log) const
{
  return Eventually(
      [&]
      {
        const std::string log = Read(hash_log);
        return std::count(log.begin(), log.end(), '\n') >= ticks;
      });
}

std::string ClusterTest::HashesOfSingleProcess(const std::string& file)
{
  const LoadedExperiment loaded = LoadExperimentFile(file);
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  if (!loaded.experiment) return {};
  SingleProcessOptions options;
  options.output_folder = folder_;
  options.hash_log = folder_ + "/single.txt";
  options.visualisations = false;
  RunSingleProcess(*loaded.experiment, options);
  return Read("single.txt");
}

void ClusterTest::ExpectNothingLeft() const
{
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(shared_folder_, none))
    EXPECT_FALSE(entry.is_directory()) << entry.path();
}

}  // namespace swarmanoid
