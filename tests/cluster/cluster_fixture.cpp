#include "tests/cluster/cluster_fixture.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "common/bus/bus.h"
#include "common/bus/membership/control_client.h"
#include "common/experiment/load_experiment.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "simulation/single_process.h"
#include "test_folders.h"
#include "tests/world/experiment_text.h"
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

ClusterTest::ClusterTest() : shared_folder_(SharedFolderOfTest())
{
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
}

ClusterTest::~ClusterTest() { fs::remove_all(shared_folder_); }

std::string ClusterTest::WriteExperiment(const std::string& name, int engines, int ticks,
                                         const std::string& visualisation)
{
  test::ExperimentText text{
      .framework = fmt::format("<maxclock>{}</maxclock><controller_path>{}</controller_path>", ticks,
                               SWARMANOID_BUILD_FOLDER "/lib/controllers"),
      .controllers = test::Controller({.tag = "footbot_diffusion",
                                       .id = "diffusion",
                                       .actuators = {"dummy_footbot_wheels", "generic_footbot_leds"},
                                       .sensors = {"generic_footbot_proximity", "engine_footbot_encoders"},
                                       .parameters = "<velocity>0.1</velocity><alpha>7.5</alpha><delta>0.1</delta>",
                                       .attributes = R"(library="footbot_diffusion")"}),
      .size = "3,3,1",
      .arena =
          "<block id='wall_0' position='0,1.5,0.25' size='0.1,3,0.5'/>"
          "<block id='wall_1' position='3,1.5,0.25' size='0.1,3,0.5'/>"
          "<block id='wall_2' position='1.5,0,0.25' size='3,0.1,0.5'/>"
          "<block id='wall_3' position='1.5,3,0.25' size='3,0.1,0.5'/>",
      .engines = "",
      .physics = "",
      .visualisations = visualisation};
  for (int e = 0; e < engines; ++e)
  {
    text.arena += fmt::format(
        "<distribute quantity='{}'><position method='uniform'/><orientation method='uniform'/>"
        "<footbot id='robots{}' controller='diffusion'/></distribute>",
        12 / engines, e);
    text.engines += fmt::format("<dummy_engine id='e{}'/>", e);
    text.physics += fmt::format("<engine id='e{0}'><entity id='wall_*'/><entity id='robots{0}_*'/></engine>", e);
  }
  return temporary_.Write(name + ".xml", text.Text());
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

std::string ClusterTest::Read(const std::string& file) const { return temporary_.Read(file); }

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
