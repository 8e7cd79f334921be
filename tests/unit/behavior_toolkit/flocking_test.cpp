// The force law of flocking, by the direction and speed that it drives a footbot at.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/control_interface/ci_robot.h"
#include "common/math/elementary.h"
#include "footbot/bt_footbot_flocking.h"
#include "tests/world/fake_devices.h"

namespace swarmanoid
{
namespace
{

constexpr double kWanted = 0.4;  // m
constexpr double kSpeed = 0.1;   // m/s

// A red neighbour: m, radians from the front.
CCI_ColourBlob Neighbour(double distance, double angle) { return {CCI_Colour::RED, distance, angle, 0}; }

// Returns the generalised Lennard-Jones force of Spears et al. (2004), cut off at 10; positive away from the neighbour.
double Force(double distance)
{
  const double ratio = kWanted / distance;
  return std::min(4 / distance * kWanted * (std::pow(ratio, 4) - std::pow(ratio, 2)), 10.0);
}

class Flocking : public testing::Test
{
protected:
  Flocking() : robot_("fb", "footbot"), flocking_(CCI_Colour::RED, kWanted, kSpeed)
  {
    robot_.AddSensor("footbot_omnidirectional_camera", &camera_);
    robot_.AddSensor("footbot_light", &light_);
    robot_.AddActuator("footbot_wheels", &wheels_);
  }
  // Returns the speeds of the left and the right wheel, m/s.
  std::array<double, 2> Drive(std::vector<CCI_ColourBlob> blobs)
  {
    camera_.blobs = std::move(blobs);
    CCI_FootBotState state(&robot_);
    state.Init();
    state.ReadSensors();
    flocking_.Step(state);
    state.WriteActuators();
    return wheels_.Speeds();
  }
  // How fast it goes: that of the faster wheel.
  double SpeedFor(std::vector<CCI_ColourBlob> blobs)
  {
    const auto [left, right] = Drive(std::move(blobs));
    return std::max(left, right);
  }

  CCI_Robot robot_;
  test::FakeCamera camera_;
  test::FakeLight light_;
  test::FakeWheels wheels_;
  CBTFootbotFlocking flocking_;
};

TEST_F(Flocking, StandsAtTheWantedDistance)
{
  EXPECT_EQ(Drive({Neighbour(kWanted, 0.3)}), (std::array<double, 2>{0, 0}));
}

TEST_F(Flocking, GoesStraightToOneThatIsTooFarAsTheForceSays)
{
  for (const double distance : {0.405, 0.41, 0.7, 0.71})
  {
    const auto [left, right] = Drive({Neighbour(distance, 0)});
    EXPECT_DOUBLE_EQ(left, right) << distance;
    EXPECT_NEAR(left, kSpeed * std::min(1.0, -2 * Force(distance)), 1e-12) << distance;
    EXPECT_GT(left, 0) << distance;
  }
}

TEST_F(Flocking, ATooNearOneBehindPushesItOn)
{
  for (const double distance : {0.38, 0.395})
  {
    const auto [left, right] = Drive({Neighbour(distance, kPi)});
    EXPECT_NEAR(left, kSpeed * std::min(1.0, 2 * Force(distance)), 1e-9) << distance;
    EXPECT_NEAR(right, left, 1e-9) << distance;
  }
}

// One ahead pulls, one behind pushes, and so on: the mean of the forces counts, not their sum.
TEST_F(Flocking, TheMeanOfTheForcesCounts)
{
  const double mean = (-Force(0.41) + Force(0.395)) / 2;
  EXPECT_NEAR(SpeedFor({Neighbour(0.41, 0), Neighbour(0.395, kPi)}), 2 * kSpeed * mean, 1e-9);
  // One much too near, at the limit of the force, against one as far as counts: the robot is driven off at full speed.
  EXPECT_NEAR(SpeedFor({Neighbour(0.05, kPi), Neighbour(0.71, kPi)}), kSpeed, 1e-9);
}

TEST_F(Flocking, ANeighbourMuchTooNearWeighsAsTenAndNotMore)
{
  // The light pulls back with 0.3 against the ten of one neighbour, which the mean over many others makes small.
  std::vector<CCI_ColourBlob> blobs(40, Neighbour(kWanted, 0));
  blobs.push_back(Neighbour(0.05, kPi));
  EXPECT_NEAR(SpeedFor(blobs), 2 * kSpeed * 10 / 41, 1e-9);
}

TEST_F(Flocking, OthersDoNotCount)
{
  EXPECT_EQ(SpeedFor({Neighbour(1.8 * kWanted + 1e-6, 0)}), 0);
  EXPECT_EQ(SpeedFor({{CCI_Colour::BLUE, 0.5, 0, 0}}), 0);
  EXPECT_EQ(SpeedFor({Neighbour(0, 0)}), 0);
  // A neighbour too far to count does not thin out the mean either.
  EXPECT_DOUBLE_EQ(SpeedFor({Neighbour(0.41, 0), Neighbour(0.8, 2)}), SpeedFor({Neighbour(0.41, 0)}));
}

TEST_F(Flocking, TheLightPullsAlikeNearAndFar)
{
  light_.readings[0] = light_.readings[23] = 0.9;
  const auto bright = Drive({});
  light_.readings[0] = light_.readings[23] = 1e-3;
  const auto dim = Drive({});
  for (const auto& [left, right] : {bright, dim})
  {
    EXPECT_NEAR(left, 2 * 0.3 * kSpeed, 1e-9);
    EXPECT_NEAR(right, left, 1e-9);
  }
}

TEST_F(Flocking, TurnsTowardsTheForce)
{
  const auto left_of_it = Drive({Neighbour(0.6, 0.4)});
  EXPECT_LT(left_of_it[0], left_of_it[1]);
  const auto right_of_it = Drive({Neighbour(0.6, -0.4)});
  EXPECT_GT(right_of_it[0], right_of_it[1]);
}

}  // namespace
}  // namespace swarmanoid
