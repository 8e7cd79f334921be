// Radios, and range and bearing, that share a channel: collisions, capture, shadowing, and the throughput of slotted
// ALOHA.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_radio.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/space/space.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

// Robots whose ids begin with s send in each step. All note whom they hear, and the strength.
class CTalker : public CCI_Controller
{
public:
  static inline std::map<std::string, std::vector<std::pair<std::string, double>>> heard;
  static inline std::map<std::string, std::size_t> bearings;  // packets of range and bearing
  static inline std::vector<bool> accepted;

  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    CCI_Robot& robot = *GetRobot();
    const bool sends = robot.GetId().starts_with("s");
    if (robot.HasSensor("radio"))
    {
      for (const auto& packet : robot.Sensor<CCI_RadioSensor>("radio").GetAllPackets())
        heard[robot.GetId()].emplace_back(std::string(packet.sender), packet.signal_db);
      if (sends)
        for (int packet = 0; packet < packets; ++packet)
          accepted.push_back(robot.Actuator<CCI_RadioActuator>("radio").Send(std::array<std::uint8_t, 1>{1}));
    }
    if (robot.HasSensor("range_and_bearing"))
    {
      bearings[robot.GetId()] += robot.Sensor<CCI_RangeAndBearingSensor>("range_and_bearing").GetAllPackets().size();
      if (sends) robot.Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage({1});
    }
  }
  static inline int packets = 1;
};
REGISTER_CONTROLLER(CTalker, "shared_channel_test")

std::string At(const std::string& id, double x, double y)
{
  return fmt::format("<footbot id='{}' position='{},{},0' controller='c'/>", id, x, y);
}

// Runs robots for some ticks; `sensor` has attributes.
void Talk(const std::string& robots, const std::string& sensor, int ticks, const std::string& actuator = "",
          std::uint64_t seed = 1)
{
  RegisterBuiltins();
  CTalker::heard.clear();
  CTalker::bearings.clear();
  CTalker::accepted.clear();
  const bool is_radio = sensor.starts_with("shared_radio");
  const auto experiment =
      test::ExperimentText{.controllers = test::Controller(
                               {.tag = "shared_channel_test",
                                .actuators = {(is_radio ? "generic_radio " : "generic_range_and_bearing ") + actuator},
                                .sensors = {sensor}}),
                           .size = "60,60,1",
                           .arena = robots}
          .Load();
  ASSERT_TRUE(experiment);
  experiment->seed = seed;
  CSimulator simulator(*experiment, {});
  for (int tick = 0; tick < ticks; ++tick) simulator.Step();
}

TEST(SharedRadio, OfOneSenderIsHeardUpToItsRangeWithTheLossOfThePath)
{
  Talk(At("s", 1, 1) + At("near", 5, 1) + At("edge", 10.9, 1) + At("far", 11.1, 1),
       "shared_radio range='10' path_loss='3'", 3);
  ASSERT_EQ(CTalker::heard["near"].size(), 2U) << "the first packet comes a tick after it is sent";
  EXPECT_EQ(CTalker::heard["near"][0].first, "s");
  EXPECT_NEAR(CTalker::heard["near"][0].second, -30 * std::log10(4.0), 1e-9);
  EXPECT_EQ(CTalker::heard["edge"].size(), 2U);
  EXPECT_TRUE(CTalker::heard["far"].empty());
  EXPECT_TRUE(CTalker::heard["s"].empty());
}

TEST(SharedRadio, LosesPacketsOfOneSlotUnlessOneIsMuchStronger)
{
  // The ratio of the powers is 20 log10(4) = 12.04 dB.
  const std::string robots = At("s1", 1, 1) + At("r", 2, 1) + At("s2", 6, 1);
  Talk(robots, "shared_radio capture='12'", 2);
  ASSERT_EQ(CTalker::heard["r"].size(), 1U);
  EXPECT_EQ(CTalker::heard["r"][0].first, "s1");
  Talk(robots, "shared_radio capture='12.1'", 2);
  EXPECT_TRUE(CTalker::heard["r"].empty());
  EXPECT_TRUE(CTalker::heard["s1"].empty()) << "it sends in the only slot itself";
  // Two disturb more than one: 4 m and 4 m are 9.03 dB.
  Talk(robots + At("s3", 2, 5), "shared_radio capture='10'", 2);
  EXPECT_TRUE(CTalker::heard["r"].empty());
  Talk(robots + At("s3", 2, 5), "shared_radio capture='9'", 2);
  EXPECT_EQ(CTalker::heard["r"].size(), 1U);
  // Equal powers never capture, and a sender out of range does not disturb.
  Talk(At("s1", 1, 1) + At("r", 2, 1) + At("s2", 3, 1), "shared_radio capture='0.1'", 2);
  EXPECT_TRUE(CTalker::heard["r"].empty());
  Talk(At("s1", 1, 1) + At("r", 2, 1) + At("s2", 13, 1), "shared_radio capture='1000'", 2);
  EXPECT_EQ(CTalker::heard["r"].size(), 1U);
}

// N senders that each take one of m slots are slotted ALOHA with p = 1 / m: a packet gets through with (1 - 1/m)^(N-1).
TEST(SharedRadio, HasTheThroughputOfSlottedAloha)
{
  constexpr int kSenders = 20, kTicks = 400;
  std::string robots = At("r", 30, 30);
  for (int k = 0; k < kSenders; ++k) robots += At(fmt::format("s{}", k), 20 + k, 20);
  for (const int slots : {10, 20, 60})
  {
    Talk(robots, fmt::format("shared_radio range='100' capture='1000' slots='{}'", slots), kTicks + 1);
    const double expected = std::pow(1 - 1.0 / slots, kSenders - 1);
    const double share = static_cast<double>(CTalker::heard["r"].size()) / (kSenders * kTicks);
    EXPECT_NEAR(share, expected, 5 * std::sqrt(expected * (1 - expected) / (kSenders * kTicks))) << slots;
    std::set<std::string> senders;
    for (const auto& [sender, signal] : CTalker::heard["r"]) senders.insert(sender);
    EXPECT_GE(senders.size(), 15U) << "all have the same chances";
  }
}

TEST(SharedRadio, HasLinksThatAreShadowedForEverAndAlikeInBothDirections)
{
  // Two robots that send in different slots hear each other equally well.
  Talk(At("s1", 1, 1) + At("s2", 6, 1), "shared_radio range='100' shadowing='8' slots='1000'", 20);
  const auto& to_first = CTalker::heard["s1"];
  const auto& to_second = CTalker::heard["s2"];
  ASSERT_GE(to_first.size(), 10U);
  for (const auto& [sender, signal] : to_first) EXPECT_EQ(signal, to_first[0].second);
  ASSERT_FALSE(to_second.empty());
  EXPECT_EQ(to_second[0].second, to_first[0].second);
  EXPECT_NE(to_first[0].second, -20 * std::log10(5.0));
  // Half of the links are stronger than usual: of 200 receivers in the range half hear the sender.
  std::string robots = At("s", 30, 30);
  for (int k = 0; k < 200; ++k)
    robots += At(fmt::format("r{}", k), 30 + 20 * std::cos(k * 0.0314159), 30 + 20 * std::sin(k * 0.0314159));
  Talk(robots, "shared_radio range='20' shadowing='6'", 2);
  std::size_t hearing = 0;
  double sum = 0, squares = 0;
  for (const auto& [id, packets] : CTalker::heard) hearing += packets.empty() ? 0 : 1;
  EXPECT_NEAR(static_cast<double>(hearing), 100, 30);
  // With a long range all hear it, with the deviation of the shadowing.
  Talk(robots, "shared_radio range='2000' shadowing='6'", 2);
  std::size_t count = 0;
  for (const auto& [id, packets] : CTalker::heard)
    for (const auto& [sender, signal] : packets)
    {
      const double off = signal + 20 * std::log10(20.0);
      sum += off;
      squares += off * off;
      ++count;
    }
  ASSERT_EQ(count, 200U);
  EXPECT_NEAR(sum / 200, 0, 4 * 6 / std::sqrt(200.0));
  EXPECT_NEAR(std::sqrt(squares / 200), 6, 4 * 6 / std::sqrt(400.0));
}

TEST(SharedRadio, RefusesPacketsBeyondTheQueue)
{
  CTalker::packets = 4;
  Talk(At("s", 1, 1), "shared_radio", 1, "queue='3'");
  EXPECT_EQ(CTalker::accepted, (std::vector<bool>{true, true, true, false}));
  Talk(At("s", 1, 1), "shared_radio", 1);
  EXPECT_EQ(CTalker::accepted, (std::vector<bool>{true, true, true, true}));
  CTalker::packets = 1;
}

TEST(SharedRangeAndBearing, LosesMessagesOfOneSlotUnlessOneIsMuchStronger)
{
  const std::string robots = At("s1", 1, 1) + At("r", 1.5, 1) + At("s2", 3.5, 1);
  Talk(robots, "shared_range_and_bearing capture='12'", 3);
  EXPECT_EQ(CTalker::bearings["r"], 2U);
  Talk(robots, "shared_range_and_bearing capture='12.1'", 3);
  EXPECT_EQ(CTalker::bearings["r"], 0U);
  EXPECT_EQ(CTalker::bearings["s1"], 0U) << "it sends in the only slot itself";
  Talk(At("s1", 1, 1) + At("r", 1.5, 1), "shared_range_and_bearing", 3);
  EXPECT_EQ(CTalker::bearings["r"], 2U);
  Talk(At("s1", 1, 1) + At("r", 1.5, 1), "shared_range_and_bearing range='0.49'", 3);
  EXPECT_EQ(CTalker::bearings["r"], 0U);
}

TEST(SharedRangeAndBearing, HasTheThroughputOfSlottedAloha)
{
  constexpr int kSenders = 12, kTicks = 400;
  std::string robots = At("r", 30, 30);
  for (int k = 0; k < kSenders; ++k)
    robots += At(fmt::format("s{}", k), 30 + 2 * std::cos(k * 0.5236), 30 + 2 * std::sin(k * 0.5236));
  Talk(robots, "shared_range_and_bearing range='5' capture='1000' slots='12'", kTicks + 1);
  const double expected = std::pow(1 - 1.0 / 12, kSenders - 1);
  const double share = static_cast<double>(CTalker::bearings["r"]) / (kSenders * kTicks);
  EXPECT_NEAR(share, expected, 5 * std::sqrt(expected * (1 - expected) / (kSenders * kTicks)));
}

}  // namespace
}  // namespace swarmanoid
