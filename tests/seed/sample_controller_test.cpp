// The sample controller of the documentation, compiled from the printed listing, drives its robot on a circle.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/experiment/load_experiment.h"
#include "common/math/elementary.h"
#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "simulation/single_process.h"
#include "tests/results/held_hash.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kExperiment = R"(<ahss-config>
  <framework>
    <clocktick>100</clocktick>
    <maxclock>962</maxclock>
  </framework>
  <controllers>
    <sample_footbot_controller id="fc" library="{}">
      <actuators>
        <footbot_wheels><implementation> dummy_footbot_wheels </implementation></footbot_wheels>
      </actuators>
      <sensors/>
    </sample_footbot_controller>
  </controllers>
  <arena size="2,2,1" optimization="2D">
    <footbot id="fb">
      <position>1, 1, 0</position>
      <orientation>0, 0, 0</orientation>
      <controller>fc</controller>
    </footbot>
  </arena>
  <engines>
    <dummy_engine id="ground">
      <subclock>1</subclock>
      <perpendicular_axis>z</perpendicular_axis>
      <distance>0</distance>
    </dummy_engine>
  </engines>
  <arena_physics>
    <engine id="ground"><entity id="fb"/></engine>
  </arena_physics>
  <visualisations>
    <text_render id="track"><file>track.txt</file><precision>9</precision></text_render>
  </visualisations>
</ahss-config>
)";

struct Place
{
  int clock = 0;
  double x = 0;
  double y = 0;
  double heading = 0;  // degrees
};

std::vector<Place> ReadTrack(const std::filesystem::path& file)
{
  std::vector<Place> track;
  std::ifstream input(file);
  for (std::string line; std::getline(input, line);)
  {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    Place place;
    std::string type;
    std::string id;
    double z = 0;
    double alpha = 0;
    double beta = 0;
    words >> place.clock >> type >> id >> place.x >> place.y >> z >> alpha >> beta >> place.heading;
    EXPECT_TRUE(words) << line;
    EXPECT_EQ(type, "Footbot");
    track.push_back(place);
  }
  return track;
}

TEST(SampleController, DrivesItsRobotOnACircle)
{
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("swarmanoid_sample_{}", getpid());
  std::filesystem::create_directories(folder);

  const LoadedExperiment loaded =
      LoadExperimentText(fmt::format(kExperiment, SAMPLE_CONTROLLER), "sample.xml", folder.string());
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  ASSERT_TRUE(loaded.experiment);
  SingleProcessOptions options;
  options.output_folder = folder.string();
  const RunSummary summary = RunSingleProcess(*loaded.experiment, options);
  EXPECT_EQ(summary.ticks, 962u);
  EXPECT_EQ(summary.hash, test::HeldHash("seed_sample_controller")) << fmt::format("{:016x}", summary.hash);
  const std::vector<Place> track = ReadTrack(folder / "track.txt");
  std::filesystem::remove_all(folder);
  ASSERT_EQ(track.size(), 963u);

  // Differential drive with the wheel speeds of the listing.
  constexpr double kLeft = 0.314 * CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;
  constexpr double kRight = 0.628 * CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;
  constexpr double kBase = CCI_FootBotWheelsActuator::INTERWHEEL_DISTANCE_M;
  constexpr double kTurn = (kRight - kLeft) / kBase;                           // rad/s
  constexpr double kRadius = kBase / 2 * (kRight + kLeft) / (kRight - kLeft);  // 0.21 m

  for (std::size_t k = 0; k < track.size(); ++k)
  {
    ASSERT_EQ(track[k].clock, static_cast<int>(k));
    EXPECT_NEAR(std::hypot(track[k].x - 1, track[k].y - 1 - kRadius), kRadius, 1e-4) << "at tick " << k;
  }
  // The first command moves the robot in the first tick, and the heading grows by the same step at each.
  for (std::size_t k = 1; k < track.size(); ++k)
  {
    const double step = WrapAngle(DegreesToRadians(track[k].heading - track[k - 1].heading));
    EXPECT_NEAR(step, kTurn * 0.1, 1e-6) << "at tick " << k;
  }
  EXPECT_NEAR(track.back().x, track.front().x, 1e-3);
  EXPECT_NEAR(track.back().y, track.front().y, 1e-3);
}

}  // namespace
}  // namespace swarmanoid
