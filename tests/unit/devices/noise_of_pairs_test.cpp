// The noise of a pair depends on the pair alone. Other entities and their actions do not change it.
#include <map>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

// Two robots are a metre apart; the third one is at a place, or there is none; the entities are listed by id, in either
// order.
class PairWorld : public TestWorld
{
public:
  PairWorld(const Vector3* third, bool third_is_first)
  {
    if (third != nullptr && third_is_first) AddNamed("third", *third);
    AddNamed("receiver", {5, 5, 0});
    AddNamed("sender", {6, 5, 0});
    if (third != nullptr && !third_is_first) AddNamed("third", *third);
    for (const std::uint32_t robot : RobotsOf(EntityKind::kFootbot))
    {
      CSwarmanoidSpaceEntity& entity = Space().GetEntity(robot);
      const bool is_sender = entity.GetId() == "sender";
      for (int led = 0; led < 12; ++led)
        entity.SetAttribute("led", is_sender ? (led < 6 ? CCI_Colour::RED : CCI_Colour::GREEN) : CCI_Colour::BLUE, led);
      entity.SetAttribute("beacon", is_sender ? CCI_Colour::YELLOW : CCI_Colour::BLUE);
    }
  }
  void SendAll()
  {
    const std::vector<std::uint32_t> robots = RobotsOf(EntityKind::kFootbot);
    TestActuator senders(*this, "range_and_bearing", "generic_range_and_bearing", robots);
    for (std::size_t k = 0; k < robots.size(); ++k)
      senders.Of<CCI_RangeAndBearingActuator>(k).SetMessage({Space().GetEntity(robots[k]).GetId() == "sender"});
    senders.Commit();
    Space().SetAttributes(senders.changes);
  }
  std::uint32_t IndexOf(const std::string& id) { return Space().FindEntity(id)->GetIndex(); }

private:
  void AddNamed(const std::string& id, const Vector3& place)
  {
    const std::uint32_t index = AddFootbot(place.x(), place.y());
    Configuration().entities[index].id = id;
  }
};

// Places of a third robot that hide nothing between the two.
std::vector<Vector3> Places()
{
  RandomStream random(3, 0, 0, 0);
  std::vector<Vector3> places;
  while (places.size() < 100)
  {
    const Vector3 place(random.Uniform(2.5, 8), random.Uniform(3.5, 6.5), 0);
    if (std::abs(place.y() - 5) > 0.35) places.push_back(place);
  }
  return places;
}

std::vector<double> PacketsOfSender(PairWorld& world)
{
  world.SendAll();
  TestSensor sensor(world, "range_and_bearing", "generic_range_and_bearing", {world.IndexOf("receiver")},
                    {{"loss_probability", "0.3"},
                     {"range_noise_kind", "gaussian"},
                     {"range_noise_deviation", "0.05"},
                     {"bearing_noise_kind", "uniform"},
                     {"bearing_noise_range", "0.05"}});
  std::vector<double> readings;
  for (std::uint64_t tick = 0; tick < 5; ++tick)
  {
    world.Space().SetTick(tick);
    sensor.Update();
    for (const auto& packet : sensor.Of<CCI_RangeAndBearingSensor>(0).GetAllPackets())
    {
      if (packet.message[0] != 1) continue;
      readings.push_back(static_cast<double>(tick));
      readings.push_back(packet.range_m);
      readings.push_back(packet.bearing_rad);
    }
  }
  return readings;
}

TEST(CommonRandomNumbers, AThirdRobotChangesNothingOnRangeAndBearingOfTwoOthers)
{
  PairWorld alone(nullptr, false);
  const std::vector<double> expected = PacketsOfSender(alone);
  ASSERT_GT(expected.size(), 3U);
  ASSERT_LT(expected.size(), 15U) << "some are lost";
  for (const Vector3& place : Places())
    for (const bool is_first : {false, true})
    {
      PairWorld world(&place, is_first);
      ASSERT_EQ(PacketsOfSender(world), expected) << place.transpose();
    }
}

// By colour: distance, angle of the blobs that only the sender shows.
std::map<std::uint32_t, std::vector<double>> BlobsOfSender(PairWorld& world, const std::string& implementation,
                                                           const TestParameters& noise)
{
  TestParameters parameters = noise;
  parameters.emplace_back("aperture", "85");
  TestSensor sensor(world, "footbot_omnidirectional_camera", implementation, {world.IndexOf("receiver")}, parameters);
  std::map<std::uint32_t, std::vector<double>> blobs;
  for (std::uint64_t tick = 0; tick < 8; ++tick)
  {
    world.Space().SetTick(tick);
    sensor.Update();
    for (const CCI_ColourBlob& blob : sensor.Of<CCI_ColourBlobSensor>(0).GetAllBlobs())
      if (blob.colour != CCI_Colour::BLUE)
        for (const double value : {static_cast<double>(tick), blob.distance_m, blob.angle_rad})
          blobs[blob.colour].push_back(value);
  }
  return blobs;
}

const TestParameters kCameraNoise{{"distance_noise_kind", "gaussian"},
                                  {"distance_noise_deviation", "0.02"},
                                  {"angle_noise_kind", "uniform"},
                                  {"angle_noise_range", "0.02"}};
const TestParameters kPixelNoise{{"noise_kind", "gaussian"}, {"noise_deviation", "5"}, {"miss_probability", "0.3"}};

TEST(CommonRandomNumbers, AThirdRobotChangesNoBlobOfAnother)
{
  for (const auto& [implementation, noise] : {std::pair("generic_footbot_omnidirectional_camera", kCameraNoise),
                                              std::pair("pixel_noise_footbot_omnidirectional_camera", kPixelNoise)})
  {
    PairWorld alone(nullptr, false);
    const auto expected = BlobsOfSender(alone, implementation, noise);
    ASSERT_EQ(expected.size(), 3U);
    for (const Vector3& place : Places())
    {
      PairWorld world(&place, true);
      ASSERT_EQ(BlobsOfSender(world, implementation, noise), expected) << place.transpose();
    }
  }
}

TEST(CommonRandomNumbers, OneBlobMoreOfARobotChangesNoOtherOfIt)
{
  PairWorld with_beacon(nullptr, false);
  const auto expected = BlobsOfSender(with_beacon, "generic_footbot_omnidirectional_camera", kCameraNoise);
  PairWorld world(nullptr, false);
  CSwarmanoidSpaceEntity& sender = world.Space().GetEntity(world.IndexOf("sender"));
  sender.SetAttribute("beacon", 0);
  auto blobs = BlobsOfSender(world, "generic_footbot_omnidirectional_camera", kCameraNoise);
  EXPECT_EQ(blobs[CCI_Colour::RED], expected.at(CCI_Colour::RED));
  EXPECT_EQ(blobs[CCI_Colour::GREEN], expected.at(CCI_Colour::GREEN));
  for (int led = 0; led < 6; ++led) sender.SetAttribute("led", 0, led);
  blobs = BlobsOfSender(world, "generic_footbot_omnidirectional_camera", kCameraNoise);
  EXPECT_EQ(blobs[CCI_Colour::GREEN], expected.at(CCI_Colour::GREEN));
}

TEST(CommonRandomNumbers, BlobsOfOneRobotDifferInTheirNoise)
{
  PairWorld world(nullptr, false);
  CSwarmanoidSpaceEntity& sender = world.Space().GetEntity(world.IndexOf("sender"));
  for (int led = 0; led < 12; ++led) sender.SetAttribute("led", CCI_Colour::RED, led);
  const auto noisy = BlobsOfSender(world, "generic_footbot_omnidirectional_camera", kCameraNoise);
  const auto exact = BlobsOfSender(world, "generic_footbot_omnidirectional_camera", {});
  // Ring and beacon are on one axis.
  const double on_ring = noisy.at(CCI_Colour::RED)[1] - exact.at(CCI_Colour::RED)[1];
  const double on_beacon = noisy.at(CCI_Colour::YELLOW)[1] - exact.at(CCI_Colour::YELLOW)[1];
  EXPECT_GT(std::abs(on_ring - on_beacon), 1e-9);
}

TEST(CommonRandomNumbers, AThirdRobotOfAnotherColourChangesNoSliceOfThePie)
{
  const auto slices = [](PairWorld& world)
  {
    TestSensor sensor(world, "pie_camera", "generic_pie_camera", {world.IndexOf("receiver")},
                      {{"noise_kind", "truncated_gaussian"}, {"noise_deviation", "0.05"}, {"noise_range", "0.1"}});
    sensor.Update();
    std::vector<double> distances;
    for (const auto& slice : sensor.Of<CCI_PieCameraSensor>(0).GetAllSlices(CCI_Colour::RED))
      distances.push_back(slice.distance_m);
    return distances;
  };
  PairWorld alone(nullptr, false);
  const auto expected = slices(alone);
  for (const Vector3& place : Places())
  {
    PairWorld world(&place, true);
    ASSERT_EQ(slices(world), expected);
  }
}

// Adding one quantity to a packet does not change the noise of the others.
TEST(CommonRandomNumbers, NoiseOnOneQuantityChangesNoOther)
{
  const auto bearing = [](const TestParameters& more)
  {
    PairWorld world(nullptr, false);
    world.SendAll();
    TestParameters parameters{{"bearing_noise_kind", "gaussian"}, {"bearing_noise_deviation", "0.1"}};
    parameters.insert(parameters.end(), more.begin(), more.end());
    TestSensor sensor(world, "range_and_bearing", "generic_range_and_bearing", {world.IndexOf("receiver")}, parameters);
    sensor.Update();
    return sensor.Of<CCI_RangeAndBearingSensor>(0).GetAllPackets()[0].bearing_rad;
  };
  EXPECT_EQ(bearing({}), bearing({{"range_noise_kind", "uniform"}, {"range_noise_range", "0.1"}}));
  EXPECT_EQ(bearing({}), bearing({{"loss_probability", "1e-9"}}));
}

TEST(CommonRandomNumbers, AnLedIsDisturbedAsBeforeWhateverTheOthersShow)
{
  const auto shown = [](bool all)
  {
    PairWorld world(nullptr, false);
    TestActuator leds(world, "footbot_leds", "generic_footbot_leds", {world.IndexOf("sender")},
                      {{"noise_kind", "uniform"}, {"noise_range", "40"}});
    CCI_FootBotLedsActuator& actuator = leds.Of<CCI_FootBotLedsActuator>(0);
    if (all)
      for (unsigned led = 0; led < 7; ++led) actuator.SetColour(led, 0x101010 * (led + 1));
    else
      actuator.SetAllColours(CCI_Colour::BLACK);
    actuator.SetColour(7, 0x808080);
    leds.Commit();
    const std::uint32_t slot = world.Space().FindEntity("sender")->SlotOf("led", 7);
    const auto place = std::find(leds.changes.slots.begin(), leds.changes.slots.end(), slot);
    return leds.changes.values.at(static_cast<std::size_t>(place - leds.changes.slots.begin()));
  };
  EXPECT_EQ(shown(true), shown(false));
  EXPECT_NE(shown(true), 0x808080);
}

}  // namespace
}  // namespace swarmanoid
