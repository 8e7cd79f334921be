// The experiments of configs/ that use dynamics2d, from their files to the end, with all roles in one process.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "common/experiment/load_experiment.h"
#include "common/space/checkpoint.h"
#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "launcher/single_process.h"
#include "test_folders.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

class Dynamics2dExperiments : public testing::Test
{
protected:
  void SetUp() override
  {
    RegisterBuiltinEngines();
    RegisterBuiltinDevices();
    RegisterBuiltinRenderers();
    folder_ = std::filesystem::temp_directory_path() / ("dynamics2d_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<Experiment> Load(const std::string& name,
                                   const std::vector<std::pair<std::string, std::string>>& settings)
  {
    LoadOptions options;
    options.settings = settings;
    LoadedExperiment loaded = LoadExperimentFile(std::string(SWARMANOID_SOURCE_FOLDER "/configs/") + name, options);
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
    return std::move(loaded.experiment);
  }

  std::filesystem::path folder_;
};

TEST_F(Dynamics2dExperiments, GoOnFromACheckpointWithTheSameHash)
{
  for (const char* const name : {"gripped_chain.xml", "diffusion_100_dynamics2d.xml"})
  {
    const auto experiment = Load(name, {{"framework.maxclock", "120"}, {"framework.canonical_period", "40"}});
    ASSERT_NE(experiment, nullptr) << name;
    SingleProcessOptions options;
    options.output_folder = folder_.string();
    options.checkpoint_every = 80;
    const RunSummary whole = RunSingleProcess(*experiment, options);
    EXPECT_EQ(whole.ticks, 120U);

    SingleProcessOptions restored;
    restored.output_folder = folder_.string();
    restored.restore_file = (folder_ / CheckpointName(80)).string();
    EXPECT_EQ(RunSingleProcess(*experiment, restored).hash, whole.hash) << name;
  }
}

TEST_F(Dynamics2dExperiments, TheGrippedChainPullsItsPrey)
{
  std::ifstream input(SWARMANOID_SOURCE_FOLDER "/configs/gripped_chain.xml");
  std::string text((std::istreambuf_iterator<char>(input)), std::istreambuf_iterator<char>());
  text.insert(text.rfind("</ahss-config>"),
              "<visualisations><text_render id=\"track\"><file>track.txt</file></text_render></visualisations>");
  const LoadedExperiment loaded = LoadExperimentText(text, "gripped_chain.xml", folder_.string());
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  ASSERT_TRUE(loaded.experiment);
  SingleProcessOptions options;
  options.output_folder = folder_.string();
  RunSingleProcess(*loaded.experiment, options);

  std::ifstream track(folder_ / "track.txt");
  std::vector<double> xs;
  for (std::string line; std::getline(track, line);)
  {
    std::istringstream words(line);
    int clock = 0;
    std::string type;
    std::string id;
    double x = 0;
    if (words >> clock >> type >> id >> x && id == "prey") xs.push_back(x);
  }
  ASSERT_EQ(xs.size(), 151U);
  EXPECT_NEAR(xs.back() - xs.front(), -0.1 * 15, 0.1) << "at the speed of the wheels, but for the start";
}

}  // namespace
}  // namespace swarmanoid
