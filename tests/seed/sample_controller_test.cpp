// The sample controller of the documentation, compiled from the printed listing, drives its robot on a circle.
#include <fmt/format.h>
#include <gtest/gtest.h>

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
#include "tests/world/experiment_text.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

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
  const test::TemporaryFolder folder;
  test::ExperimentText text;
  text.framework = "<maxclock>962</maxclock>";
  text.controllers = test::Controller({.tag = "sample_footbot_controller",
                                       .id = "fc",
                                       .actuators = {"dummy_footbot_wheels"},
                                       .attributes = "library='" SAMPLE_CONTROLLER "'"});
  text.size = "2,2,1";
  text.arena = "<footbot id='fb' position='1,1,0' controller='fc'/>";
  text.engines = "<dummy_engine id='ground'/>";
  text.physics = "<engine id='ground'><all/></engine>";
  text.visualisations = "<text_render id='track' file='track.txt' precision='9'/>";
  const auto experiment = text.Load(folder.Path());
  ASSERT_TRUE(experiment);
  SingleProcessOptions options;
  options.output_folder = folder.Path();
  const RunSummary summary = RunSingleProcess(*experiment, options);
  EXPECT_EQ(summary.ticks, 962u);
  EXPECT_EQ(summary.hash, test::HeldHash("seed_sample_controller")) << fmt::format("{:016x}", summary.hash);
  const std::vector<Place> track = ReadTrack(folder / "track.txt");
  ASSERT_EQ(track.size(), 963u);

  // The robot has a differential drive with the wheel speeds of the listing.
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
