// Radio: range, latency, loss and bandwidth of packets.
#include <numeric>

#include "common/control_interface/ci_radio.h"
#include "tests/unit/devices/test_world.h"

namespace swarmanoid
{
namespace
{

// The robots are in a row, 1 m apart, all with a radio.
class Row : public TestWorld
{
public:
  explicit Row(int count, const TestParameters& sender = {}, const TestParameters& receiver = {})
  {
    for (int k = 0; k < count; ++k) robots_.push_back(AddFootbot(0.5 + k, 5));
    senders_ = std::make_unique<TestActuator>(*this, "radio", "generic_radio", robots_, sender);
    receivers_ = std::make_unique<TestSensor>(*this, "radio", "generic_radio", robots_, receiver);
  }
  // Runs a tick as a host does: sensors, controllers, actuators, then the state of the next tick.
  template <class Act>
  void Tick(Act act)
  {
    receivers_->Update();
    act();
    senders_->Commit();
    Space().SetAttributes(senders_->changes);
    Space().SetTick(Space().GetTick() + 1);
  }
  bool Send(std::size_t k, std::vector<std::uint8_t> bytes) { return senders_->Of<CCI_RadioActuator>(k).Send(bytes); }
  std::span<const CCI_RadioSensor::Packet> Heard(std::size_t k)
  {
    return receivers_->Of<CCI_RadioSensor>(k).GetAllPackets();
  }
  // Does what a host does to the radio of a robot that on_failure stops.
  void Silence(std::size_t k)
  {
    const CSwarmanoidSpaceEntity& entity = Space().GetEntity(robots_[k]);
    AttributeChanges changes;
    for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
      for (int element = 0; spec.name == "radio" && element < spec.count; ++element)
        changes.Add(entity.SlotOf("radio", element), 0);
    Space().SetAttributes(changes);
  }
  TestActuator& Senders() { return *senders_; }
  TestSensor& Receivers() { return *receivers_; }

private:
  std::vector<std::uint32_t> robots_;
  std::unique_ptr<TestActuator> senders_;
  std::unique_ptr<TestSensor> receivers_;
};

TEST(Radio, APacketArrivesOnceAtAllInRange)
{
  Row row(5, {}, {{"range", "2.5"}});
  std::vector<std::uint8_t> bytes(CCI_RadioActuator::MAX_BYTES);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{230});
  row.Tick([&] { EXPECT_TRUE(row.Send(1, bytes)); });
  row.Tick(
      [&]
      {
        for (const std::size_t k : {0U, 2U, 3U})
        {
          ASSERT_EQ(row.Heard(k).size(), 1U) << k;
          const auto& packet = row.Heard(k)[0];
          EXPECT_EQ(packet.sender, "e1");
          EXPECT_TRUE(std::equal(packet.Bytes().begin(), packet.Bytes().end(), bytes.begin(), bytes.end()));
          EXPECT_NEAR(packet.signal_db, k == 3 ? -20 * std::log10(2.0) : 0, 1e-9);
        }
        EXPECT_EQ(row.Heard(1).size(), 0U) << "no robot hears itself";
        EXPECT_EQ(row.Heard(4).size(), 0U) << "3 m away";
      });
  row.Tick([&] { EXPECT_EQ(row.Heard(0).size(), 0U) << "sent once, heard once"; });
}

TEST(Radio, ARobotThatIsStoppedSendsNoPacket)
{
  Row row(2);
  row.Tick([&] { row.Send(0, {7}); });
  row.Tick([&] { EXPECT_EQ(row.Heard(1).size(), 1U); });
  row.Silence(0);
  row.Receivers().Update();
  EXPECT_EQ(row.Heard(1).size(), 0U);
}

TEST(Radio, TwoPacketsAlikeAreTwoPackets)
{
  Row row(2);
  row.Tick([&] { row.Send(0, {7}); });
  row.Tick(
      [&]
      {
        EXPECT_EQ(row.Heard(1).size(), 1U);
        row.Send(0, {7});
      });
  row.Tick([&] { EXPECT_EQ(row.Heard(1).size(), 1U); });
}

// 0.25 s are three ticks of 0.1 s beyond the one that everything takes.
TEST(Radio, LatencyDelaysPackets)
{
  Row row(2, {}, {{"latency", "0.25"}});
  for (int tick = 0; tick < 8; ++tick)
    row.Tick(
        [&]
        {
          EXPECT_EQ(row.Heard(1).size(), tick == 4 || tick == 5 ? 1U : 0U) << tick;
          if (tick < 2) row.Send(0, {static_cast<std::uint8_t>(tick)});
        });
}

// A free channel takes the 30 bytes of a longest packet at once; then ten bytes need a second at 10 bytes/s.
TEST(Radio, BandwidthMakesPacketsWait)
{
  Row row(2, {{"bandwidth", "10"}});
  std::vector<int> arrivals;
  for (int tick = 0; tick < 80; ++tick)
    row.Tick(
        [&]
        {
          if (!row.Heard(1).empty()) arrivals.push_back(tick);
          if (tick > 0) return;
          for (int packet = 0; packet < 16; ++packet) EXPECT_TRUE(row.Send(0, std::vector<std::uint8_t>(10)));
          EXPECT_FALSE(row.Send(0, {1})) << "sixteen wait already";
        });
  ASSERT_GE(arrivals.size(), 6U);
  EXPECT_EQ((std::vector<int>(arrivals.begin(), arrivals.begin() + 6)), (std::vector<int>{1, 2, 3, 11, 21, 31}));
}

TEST(Radio, LosesItsShareOfPackets)
{
  Row row(2, {}, {{"loss_probability", "0.3"}});
  int heard = 0;
  constexpr int kTicks = 3000;
  for (int tick = 0; tick < kTicks; ++tick)
    row.Tick(
        [&]
        {
          heard += static_cast<int>(row.Heard(1).size());
          row.Send(0, {1});
        });
  EXPECT_NEAR(heard, 0.7 * kTicks, 4 * std::sqrt(kTicks * 0.3 * 0.7));
}

TEST(Radio, APacketThatIsTooLongIsRefused)
{
  Row row(1);
  EXPECT_THROW(row.Send(0, std::vector<std::uint8_t>(31)), std::length_error);
}

// Packets that wait and packets that fly are part of the saved state.
TEST(Radio, GoesOnFromASavedState)
{
  const TestParameters slow{{"bandwidth", "30"}}, late{{"latency", "0.4"}};
  Row whole(2, slow, late), restored(2, slow, late);
  const auto heard = [](Row& row)
  {
    std::vector<int> bytes;
    row.Tick(
        [&]
        {
          for (const auto& packet : row.Heard(1)) bytes.push_back(packet.bytes[0]);
        });
    return bytes;
  };
  whole.Tick(
      [&]
      {
        for (std::uint8_t i = 0; i < 8; ++i) whole.Send(0, std::vector<std::uint8_t>(10, i));
      });
  for (int tick = 1; tick < 7; ++tick) heard(whole);
  ByteWriter saved;
  whole.Receivers().batch->SaveCommon(saved);
  for (std::size_t robot = 0; robot < whole.Space().Size(); ++robot)
  {
    whole.Senders().batch->SaveState(robot, saved);
    whole.Receivers().batch->SaveState(robot, saved);
  }
  ByteReader reader(saved.Bytes());
  restored.Receivers().batch->LoadCommon(reader);
  for (std::size_t robot = 0; robot < whole.Space().Size(); ++robot)
  {
    restored.Senders().batch->LoadState(robot, reader);
    restored.Receivers().batch->LoadState(robot, reader);
  }
  EXPECT_TRUE(reader.AtEnd());
  restored.Space().SetTick(whole.Space().GetTick());
  for (std::uint32_t slot = 0; slot < whole.Space().Attributes().size(); ++slot)
    restored.Space().SetAttribute(slot, whole.Space().Attributes()[slot]);
  int all = 0;
  for (int tick = 7; tick < 60; ++tick)
  {
    const std::vector<int> expected = heard(whole);
    ASSERT_EQ(heard(restored), expected) << tick;
    all += static_cast<int>(expected.size());
  }
  EXPECT_GT(all, 3);
}

}  // namespace
}  // namespace swarmanoid
