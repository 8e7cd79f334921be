#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

constexpr double kRadius = CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;

TEST(FootbotWheels, IdealWheelsTurnAsToldUpToTheLargestSpeed)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  world.AddFootbot(2, 2);
  TestActuator wheels(world, "footbot_wheels", "dummy_footbot_wheels", {0, 1});
  wheels.Of<CCI_FootBotWheelsActuator>(0).SetFootBotWheelsAngularVelocity(0.314, 0.628);
  wheels.Of<CCI_FootBotWheelsActuator>(1).SetFootBotWheelsLinearVelocity(-1, 0.2);
  wheels.Commit();
  EXPECT_EQ(wheels.values[0], 0.314);
  EXPECT_EQ(wheels.values[1], 0.628);
  EXPECT_DOUBLE_EQ(wheels.values[2] * kRadius, -0.3);
  EXPECT_DOUBLE_EQ(wheels.values[3] * kRadius, 0.2);
}

TEST(FootbotWheels, ValuesStayUntilSetAgainAndNaNStaysOne)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  TestActuator wheels(world, "footbot_wheels", "dummy_footbot_wheels", {0}, {{"max_speed", "0.1"}});
  auto& device = wheels.Of<CCI_FootBotWheelsActuator>(0);
  device.SetAllActuatorOutputs({1, 2});
  wheels.Commit();
  wheels.Commit();
  EXPECT_EQ(wheels.values[0], 1);
  EXPECT_EQ(wheels.values[1], 2);
  device.SetFootBotWheelsAngularVelocity(__builtin_nan(""), 100);
  wheels.Commit();
  EXPECT_TRUE(wheels.values[0] != wheels.values[0]);
  EXPECT_DOUBLE_EQ(wheels.values[1] * kRadius, 0.1);
}

TEST(FootbotWheels, NoiseHasTheGivenMomentsAndLeavesStandingWheelsAlone)
{
  TestWorld world;
  for (int i = 0; i < 20; ++i) world.AddFootbot(0.4 * i, 1);
  TestActuator wheels(
      world, "footbot_wheels", "noisy_footbot_wheels", world.RobotsOf(EntityKind::kFootbot),
      {{"bias_left", "0.01"}, {"factor_right", "0.9"}, {"noise_kind", "gaussian"}, {"noise_deviation", "0.02"}});
  for (std::size_t k = 1; k < 20; ++k) wheels.Of<CCI_FootBotWheelsActuator>(k).SetFootBotWheelsLinearVelocity(0.1, 0.1);
  double sums[2] = {0, 0}, squares[2] = {0, 0};
  int count = 0;
  for (std::uint64_t tick = 1; tick <= 1000; ++tick)
  {
    world.Space().SetTick(tick);
    wheels.Commit();
    ASSERT_EQ(wheels.values[0], 0);
    for (std::size_t k = 1; k < 20; ++k, ++count)
      for (std::size_t side = 0; side < 2; ++side)
      {
        const double v = wheels.values[2 * k + side] * kRadius;
        sums[side] += v;
        squares[side] += v * v;
      }
  }
  // The standard errors of 19,000 samples are 1.5e-4 for the mean and 1e-4 for the deviation.
  for (const int side : {0, 1})
  {
    const double mean = sums[side] / count;
    EXPECT_NEAR(mean, side == 0 ? 0.11 : 0.09, 6e-4);
    EXPECT_NEAR(std::sqrt(squares[side] / count - mean * mean), 0.02, 4e-4);
  }
}

TEST(FootbotWheels, NoiseDependsOnSeedEntityAndTickAlone)
{
  const auto values = [](std::vector<std::uint32_t> robots)
  {
    TestWorld world;
    for (int i = 0; i < 3; ++i) world.AddFootbot(i, 1);
    TestActuator wheels(world, "footbot_wheels", "noisy_footbot_wheels", robots,
                        {{"noise_kind", "uniform"}, {"noise_range", "0.05"}});
    for (std::size_t k = 0; k < robots.size(); ++k)
      wheels.Of<CCI_FootBotWheelsActuator>(k).SetFootBotWheelsAngularVelocity(1, 1);
    world.Space().SetTick(17);
    wheels.Commit();
    return wheels.values;
  };
  const auto all = values({0, 1, 2});
  EXPECT_EQ(values({2}), std::vector<double>(all.begin() + 4, all.end()));
  EXPECT_NE(all[0], all[2]);
}

TEST(FootbotWheels, SpeedControllerApproachesExponentiallyAndKeepsItsState)
{
  TestWorld world;  // ticks of 0.1 s
  world.AddFootbot(1, 1);
  const TestParameters parameters{{"time_constant", "0.2"}};
  TestActuator wheels(world, "footbot_wheels", "pid_footbot_wheels", {0}, parameters);
  wheels.Of<CCI_FootBotWheelsActuator>(0).SetFootBotWheelsAngularVelocity(4, -4);
  wheels.Commit();
  EXPECT_NEAR(wheels.values[0], 4 * (1 - std::exp(-0.5)), 1e-12);
  wheels.Commit();
  EXPECT_NEAR(wheels.values[1], -4 * (1 - std::exp(-1.0)), 1e-12);

  ByteWriter saved;
  wheels.batch->SaveState(0, saved);
  TestActuator restored(world, "footbot_wheels", "pid_footbot_wheels", {0}, parameters);
  ByteReader reader(saved.Bytes());
  restored.batch->LoadState(0, reader);
  wheels.Commit();
  restored.Commit();
  EXPECT_EQ(wheels.values, restored.values);
}

TEST(FootbotWheels, SpeedControllerKeepsWithinTheAcceleration)
{
  TestWorld world;
  world.AddFootbot(1, 1);
  TestActuator wheels(world, "footbot_wheels", "pid_footbot_wheels", {0},
                      {{"time_constant", "0"}, {"max_acceleration", "0.5"}});
  wheels.Of<CCI_FootBotWheelsActuator>(0).SetFootBotWheelsLinearVelocity(0.12, 0);
  for (const double expected : {0.05, 0.1, 0.12})
  {
    wheels.Commit();
    EXPECT_NEAR(wheels.values[0] * kRadius, expected, 1e-12);
  }
}

// ARGoS3 has a = f (w + b): b of each wheel is drawn once, f in every tick, for both wheels while one of them moves.
TEST(Argos3Wheels, HaveABiasForGoodAndAFactorOfTheTick)
{
  TestWorld world;
  std::vector<std::uint32_t> robots;
  for (int k = 0; k < 2000; ++k) robots.push_back(world.AddFootbot(0.2 + 0.2 * (k % 45), 0.2 + 0.2 * (k / 45)));
  const auto speeds = [&](const TestParameters& parameters, std::uint64_t tick, double left, double right)
  {
    world.Space().SetTick(tick);
    TestActuator wheels(world, "footbot_wheels", "argos3_footbot_wheels", robots, parameters);
    for (std::size_t k = 0; k < robots.size(); ++k)
      wheels.Of<CCI_FootBotWheelsActuator>(k).SetFootBotWheelsLinearVelocity(left, right);
    wheels.Commit();
    std::vector<double> all = wheels.values;
    for (double& speed : all) speed *= kRadius;
    return all;
  };
  const auto moments = [](const std::vector<double>& all, std::size_t side)
  {
    double sum = 0, squares = 0;
    for (std::size_t i = side; i < all.size(); i += 2)
    {
      sum += all[i];
      squares += all[i] * all[i];
    }
    const double count = static_cast<double>(all.size() / 2);
    return std::pair(sum / count, std::sqrt(squares / count - sum / count * (sum / count)));
  };
  // Without its noise the speed is that of the command, above 0.3 m/s too.
  for (const double speed : speeds({}, 3, 0.4, 0.4)) ASSERT_NEAR(speed, 0.4, 1e-12);

  const TestParameters bias{{"bias_avg_left", "0.01"}, {"bias_stddev_left", "0.02"}, {"bias_stddev_right", "0.005"}};
  const std::vector<double> biased = speeds(bias, 3, 0.1, 0);
  EXPECT_EQ(biased, speeds(bias, 4, 0.1, 0)) << "drawn once";
  for (const double speed : speeds(bias, 4, 0, 0)) ASSERT_EQ(speed, 0) << "one that stands has no noise";
  const double error = 4 / std::sqrt(2000);
  EXPECT_NEAR(moments(biased, 0).first, 0.11, 0.02 * error);
  EXPECT_NEAR(moments(biased, 0).second, 0.02, 0.02 * error);
  EXPECT_NEAR(moments(biased, 1).first, 0, 0.005 * error) << "the wheel that is told to stand turns with its bias";
  EXPECT_NEAR(moments(biased, 1).second, 0.005, 0.005 * error);

  const TestParameters factor{{"bias_avg_right", "0.05"}, {"factor_avg_right", "0.5"}, {"factor_stddev_right", "0.1"}};
  const std::vector<double> scaled = speeds(factor, 3, 0.1, 0.1);
  EXPECT_NE(scaled, speeds(factor, 4, 0.1, 0.1)) << "drawn in every tick";
  EXPECT_NEAR(moments(scaled, 0).first, 0.1, 1e-12);
  EXPECT_NEAR(moments(scaled, 1).first, 0.5 * 0.15, 0.1 * 0.15 * error);
  EXPECT_NEAR(moments(scaled, 1).second, 0.1 * 0.15, 0.1 * 0.15 * error);
}

}  // namespace
}  // namespace swarmanoid
