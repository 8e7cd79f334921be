#include "common/control_interface/ci_range_and_bearing.h"

#include <algorithm>
#include <numeric>

#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

using Packets = std::span<const CCI_RangeAndBearingSensor::Packet>;

Packets PacketsOf(TestSensor& sensor, std::size_t k) { return sensor.Of<CCI_RangeAndBearingSensor>(k).GetAllPackets(); }

CCI_RangeAndBearingActuator::Message Numbered(std::uint8_t first)
{
  CCI_RangeAndBearingActuator::Message message;
  for (std::uint8_t i = 0; i < message.size(); ++i) message[i] = static_cast<std::uint8_t>(first + 23 * i);
  return message;
}

void Send(TestWorld& world, TestActuator& senders, const std::vector<std::size_t>& who)
{
  for (const std::size_t k : who)
    senders.Of<CCI_RangeAndBearingActuator>(k).SetMessage(Numbered(static_cast<std::uint8_t>(200 + k)));
  senders.Commit();
  world.Space().SetAttributes(senders.changes);
}

TEST(RangeAndBearing, AllTenBytesArriveWithRangeAndBearing)
{
  TestWorld world;
  world.AddFootbot(5, 5, kPi / 2);
  world.AddFootbot(6, 5);
  world.AddEyebot(5, 6, 1);
  world.AddFootbot(4, 5);    // silent
  world.AddFootbot(8.1, 5);  // too far
  const std::vector<std::uint32_t> robots{0, 1, 2, 3, 4};
  TestActuator senders(world, "range_and_bearing", "generic_range_and_bearing", robots);
  TestSensor receivers(world, "range_and_bearing", "generic_range_and_bearing", robots);
  receivers.Update();
  EXPECT_TRUE(PacketsOf(receivers, 0).empty());
  Send(world, senders, {1, 2, 4});
  receivers.Update();
  ASSERT_EQ(PacketsOf(receivers, 0).size(), 2U);
  for (const auto& packet : PacketsOf(receivers, 0))
  {
    if (packet.message == Numbered(201))
    {
      EXPECT_NEAR(packet.range_m, 1, 1e-12);
      EXPECT_NEAR(packet.bearing_rad, -kPi / 2, 1e-12);
      EXPECT_EQ(packet.vertical_bearing_rad, 0);
    }
    else
    {
      EXPECT_EQ(packet.message, Numbered(202));
      EXPECT_NEAR(packet.range_m, std::sqrt(2), 1e-12);
      EXPECT_NEAR(packet.bearing_rad, 0, 1e-12);
      EXPECT_NEAR(packet.vertical_bearing_rad, kPi / 4, 1e-12);
    }
  }

  senders.Of<CCI_RangeAndBearingActuator>(1).StopSending();
  senders.Commit();
  world.Space().SetAttributes(senders.changes);
  receivers.Update();
  EXPECT_EQ(PacketsOf(receivers, 0).size(), 1U);
}

TEST(RangeAndBearing, RobotsAndBlocksBlockIt)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(7, 5);
  world.AddFootbot(6, 5.08);  // overlaps the line
  world.AddFootbot(5, 7);
  world.AddFootbot(5.09, 6);  // just beside the line
  world.AddFootbot(5, 3);
  world.AddBlock({5, 4, 0.05}, {1, 0.02, 0.09});  // lower than the antenna
  world.AddFootbot(3, 5);
  world.AddBlock({4, 5, 0.055}, {0.02, 1, 0.11});  // higher than the antenna
  const auto robots = world.RobotsOf(EntityKind::kFootbot);
  TestActuator senders(world, "range_and_bearing", "generic_range_and_bearing", robots);
  TestSensor receivers(world, "range_and_bearing", "generic_range_and_bearing", robots);
  Send(world, senders, {1, 3, 5, 6});
  receivers.Update();
  std::vector<int> heard;
  for (const auto& packet : PacketsOf(receivers, 0)) heard.push_back(packet.message[0] - 200);
  std::sort(heard.begin(), heard.end());
  EXPECT_EQ(heard, (std::vector<int>{3, 5}));
}

// The messages of a robot do not depend on other receivers, nor on the number of other senders.
TEST(RangeAndBearing, EachReceiverOfACrowdHearsWhatItHearsAlone)
{
  TestWorld world;
  RandomStream random(5, 5, 5, 5);
  for (int n = 0; n < 120; ++n)
    world.AddFootbot(random.Uniform(0, 10), random.Uniform(0, 10), random.Uniform(-kPi, kPi));
  const auto robots = world.RobotsOf(EntityKind::kFootbot);
  TestActuator senders(world, "range_and_bearing", "generic_range_and_bearing", robots);
  TestSensor crowd(world, "range_and_bearing", "generic_range_and_bearing", robots);
  std::vector<std::size_t> all(robots.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Send(world, senders, {all.begin(), all.begin() + 55});
  crowd.Update();
  std::vector<std::vector<CCI_RangeAndBearingSensor::Packet>> of_few;
  for (const std::size_t k : all) of_few.emplace_back(PacketsOf(crowd, k).begin(), PacketsOf(crowd, k).end());

  Send(world, senders, all);
  crowd.Update();
  const CSwarmanoidSpace& space = world.Space();
  std::size_t packets = 0;
  for (const std::size_t k : all)
  {
    TestSensor alone(world, "range_and_bearing", "generic_range_and_bearing", {robots[k]});
    alone.Update();
    const Packets expected = PacketsOf(alone, 0);
    const Packets received = PacketsOf(crowd, k);
    ASSERT_EQ(received.size(), expected.size());
    std::size_t of_first = 0;
    for (std::size_t i = 0; i < received.size(); ++i)
    {
      ASSERT_EQ(received[i].range_m, expected[i].range_m);
      ASSERT_EQ(received[i].bearing_rad, expected[i].bearing_rad);
      ASSERT_EQ(received[i].message, expected[i].message);
      const std::size_t sender = static_cast<std::uint8_t>(received[i].message[0] - 200);
      const Vector3 way = space.GetPose(robots[k]).Inverse().Apply(space.GetPose(robots[sender]).position);
      ASSERT_NEAR(received[i].range_m, way.norm(), 1e-12);
      ASSERT_NEAR(received[i].bearing_rad, std::atan2(way.y(), way.x()), 1e-12);
      if (sender >= 55) continue;
      ASSERT_LT(of_first, of_few[k].size());
      ASSERT_EQ(received[i].range_m, of_few[k][of_first++].range_m);
    }
    ASSERT_EQ(of_first, of_few[k].size());
    packets += received.size();
  }
  EXPECT_GT(packets, 1500U);
}

// The way from antenna to antenna in the frame of the receiver's body decides all three numbers. The test has robots at
// different heights, receivers and senders that lean, few or many senders, and packets lost or not.
TEST(RangeAndBearing, EveryPacketIsOfItsSenderInThreeDimensions)
{
  for (const bool leaning : {false, true})
    for (const std::size_t senders_count : {8U, 24U})
      for (const char* const loss : {"0", "0.4"})
      {
        SCOPED_TRACE(testing::Message() << leaning << " " << senders_count << " " << loss);
        TestWorld world;
        RandomStream random(6, 0, 0, 0);
        for (int n = 0; n < 12; ++n)
          world.AddFootbot(random.Uniform(4, 6), random.Uniform(4, 6), random.Uniform(-kPi, kPi));
        for (int n = 0; n < 12; ++n)
          world.AddEyebot(random.Uniform(4, 6), random.Uniform(4, 6), random.Uniform(0.5, 2),
                          random.Uniform(-kPi, kPi));
        CSwarmanoidSpace& space = world.Space();
        if (leaning)
          for (std::uint32_t robot = 0; robot < 24; robot += 2)
            space.SetPose(robot, {space.GetPose(robot).position,
                                  QuaternionFromEuler({random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5),
                                                       random.Uniform(-kPi, kPi)})});
        std::vector<std::uint32_t> robots(24);
        std::iota(robots.begin(), robots.end(), 0U);
        TestActuator senders(world, "range_and_bearing", "generic_range_and_bearing", robots);
        TestSensor receivers(world, "range_and_bearing", "generic_range_and_bearing", robots,
                             {{"loss_probability", loss}});
        std::vector<std::size_t> sending(senders_count);
        std::iota(sending.begin(), sending.end(), std::size_t{0});
        Send(world, senders, sending);
        receivers.Update();
        std::size_t packets = 0;
        for (std::uint32_t k = 0; k < 24; ++k)
          for (const auto& packet : PacketsOf(receivers, k))
          {
            const auto sender = static_cast<std::uint8_t>(packet.message[0] - 200);
            ASSERT_LT(sender, senders_count);
            const Vector3 antenna(0, 0, 0.1);
            const Vector3 way = space.GetPose(k).Inverse().Apply(space.GetPose(sender).Apply(antenna)) - antenna;
            EXPECT_NEAR(packet.range_m, way.norm(), 1e-9);
            EXPECT_NEAR(WrapAngle(packet.bearing_rad - std::atan2(way.y(), way.x())), 0, 1e-9);
            EXPECT_NEAR(packet.vertical_bearing_rad, std::atan2(way.z(), way.head<2>().norm()), 1e-9);
            ++packets;
          }
        EXPECT_GT(packets, senders_count * 4);
      }
}

TEST(RangeAndBearing, LossAndNoiseAsAsked)
{
  TestWorld world;
  for (int n = 0; n < 11; ++n) world.AddFootbot(5 + std::cos(0.5 * n), 5 + std::sin(0.5 * n));
  world.AddFootbot(5, 5);
  const auto robots = world.RobotsOf(EntityKind::kFootbot);
  TestActuator senders(world, "range_and_bearing", "generic_range_and_bearing", robots);
  TestSensor receivers(world, "range_and_bearing", "generic_range_and_bearing", {11},
                       {{"loss_probability", "0.3"}, {"range_noise_kind", "uniform"}, {"range_noise_range", "0.1"}});
  Send(world, senders, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  int received = 0;
  double squares = 0, squares_of_counts = 0;
  for (std::uint64_t tick = 0; tick < 1000; ++tick)
  {
    world.Space().SetTick(tick);
    receivers.Update();
    squares_of_counts += std::pow(static_cast<double>(PacketsOf(receivers, 0).size()), 2);
    for (const auto& packet : PacketsOf(receivers, 0))
    {
      ++received;
      ASSERT_NEAR(packet.range_m, 1, 0.1);
      squares += (packet.range_m - 1) * (packet.range_m - 1);
    }
  }
  EXPECT_NEAR(received / 11000.0, 0.7, 4 * std::sqrt(0.21 / 11000));
  EXPECT_NEAR(squares_of_counts / 1000 - std::pow(received / 1000.0, 2), 11 * 0.21, 0.5) << "each is lost by itself";
  EXPECT_NEAR(squares / received, 0.01 / 3, 2e-4);
}

// From behind and near, so that noise leaves what a reading can be.
TEST(RangeAndBearing, NoiseLeavesNoReadingOutsideItsRange)
{
  TestWorld world;
  world.AddFootbot(5, 5);
  world.AddFootbot(4.8, 5);
  TestActuator senders(world, "range_and_bearing", "generic_range_and_bearing", {0, 1});
  TestSensor receivers(world, "range_and_bearing", "generic_range_and_bearing", {0},
                       {{"range_noise_kind", "uniform"},
                        {"range_noise_range", "0.5"},
                        {"bearing_noise_kind", "uniform"},
                        {"bearing_noise_range", "0.5"},
                        {"vertical_bearing_noise_kind", "uniform"},
                        {"vertical_bearing_noise_range", "3"}});
  Send(world, senders, {1});
  bool cut = false, left = false, right = false, up = false, down = false;
  for (std::uint64_t tick = 0; tick < 300; ++tick)
  {
    world.Space().SetTick(tick);
    receivers.Update();
    ASSERT_EQ(PacketsOf(receivers, 0).size(), 1U);
    const auto& packet = PacketsOf(receivers, 0)[0];
    ASSERT_GE(packet.range_m, 0);
    ASSERT_GE(std::abs(packet.bearing_rad), kPi - 0.5);
    ASSERT_LE(std::abs(packet.bearing_rad), kPi);
    ASSERT_LE(std::abs(packet.vertical_bearing_rad), kPi / 2);
    cut |= packet.range_m == 0;
    (packet.bearing_rad > 0 ? left : right) = true;
    up |= packet.vertical_bearing_rad == kPi / 2;
    down |= packet.vertical_bearing_rad == -kPi / 2;
  }
  EXPECT_TRUE(cut && left && right && up && down);
}

}  // namespace
}  // namespace swarmanoid
