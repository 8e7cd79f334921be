// Messages of range and bearing of more than ten bytes: as numbers, as slots of the space, from sender to receiver.
#include <numeric>

#include "common/configuration/parameter_table.h"
#include "common/configuration/xml_reader.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/messages/range_and_bearing_message.h"
#include "common/space/message_slots.h"
#include "common/space/state_checks.h"
#include "tests/unit/devices/test_world.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kType = "range_and_bearing";
constexpr const char* kImplementation = "generic_range_and_bearing";

std::vector<std::uint8_t> Numbered(std::size_t count, unsigned first)
{
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(first + 37 * i + i / 251);
  return bytes;
}

// A controller whose messages have that many bytes, of the robots that are added for it.
void AddController(TestWorld& world, const std::string& id, int bytes)
{
  ControllerConfiguration controller;
  controller.id = id;
  controller.actuators.push_back({kType, kImplementation, TreeOf({{"bytes", std::to_string(bytes)}})});
  world.Configuration().controllers.push_back(controller);
}
std::uint32_t AddFootbot(TestWorld& world, double x, const std::string& controller)
{
  const std::uint32_t robot = world.AddFootbot(x, 5);
  world.Configuration().entities.back().controller = controller;
  return robot;
}

std::vector<std::uint8_t> BytesOf(const CCI_RangeAndBearingSensor& sensor,
                                  const CCI_RangeAndBearingSensor::Packet& packet)
{
  std::vector<std::uint8_t> bytes(packet.message.begin(), packet.message.end());
  const auto further = sensor.GetFurtherBytes(packet);
  bytes.insert(bytes.end(), further.begin(), further.end());
  return bytes;
}

TEST(LongMessages, BytesComeOutOfNumbersAsTheyWentIn)
{
  for (const std::size_t count : {0, 1, 4, 5, 6, 9, 10, 11, 14, 15, 16, 9999, 10000})
  {
    const auto bytes = Numbered(count, 255);
    const std::size_t numbers = (count + kBytesInNumber - 1) / kBytesInNumber;
    std::vector<double> values(numbers + 1, -1);
    PackBytes(bytes, values.data());
    EXPECT_EQ(values.back(), -1) << "one number too many for " << count;
    for (std::size_t i = 0; i < numbers; ++i)
      EXPECT_TRUE(values[i] >= 0 && values[i] < 0x1p40 && values[i] == std::floor(values[i])) << values[i];
    std::vector<std::uint8_t> again(count);
    UnpackBytes(values.data(), again);
    EXPECT_EQ(again, bytes);
  }
  // The first one is the highest; zeros follow the last.
  double value = 0;
  PackBytes(std::vector<std::uint8_t>{1, 2}, &value);
  EXPECT_EQ(value, 0x0102000000);
}

TEST(LongMessages, ARobotHasAsManySlotsAsItsMessagesNeed)
{
  for (const auto& [bytes, further] : {std::pair(10, 0), {11, 1}, {15, 1}, {16, 2}, {9'999, 1'998}, {10'000, 1'998}})
  {
    TestWorld world;
    AddController(world, "long", bytes);
    AddController(world, "short", 10);
    AddFootbot(world, 5, "long");
    AddFootbot(world, 6, "short");
    const Experiment& experiment = world.Configuration();
    EXPECT_EQ(MessageBytes(experiment, experiment.entities[0]), bytes);
    EXPECT_EQ(FurtherMessageSlots(experiment, experiment.entities[0]), further);
    EXPECT_EQ(FurtherMessageSlots(experiment, experiment.entities[1]), 0);
    const CSwarmanoidSpaceEntity& robot = world.Space().GetEntity(0);
    const CSwarmanoidSpaceEntity& next = world.Space().GetEntity(1);
    EXPECT_EQ(next.FirstSlot() - robot.FirstSlot(), AttributeCount(EntityKind::kFootbot) + further);
    // Behind all that the kind has.
    if (further > 0)
    {
      EXPECT_EQ(robot.SlotOf("message", 3), robot.FirstSlot() + AttributeCount(EntityKind::kFootbot));
      EXPECT_EQ(robot.SlotOf("message", 2 + further), next.FirstSlot() - 1);
    }
    EXPECT_THROW(static_cast<void>(robot.SlotOf("message", 3 + further)), std::out_of_range);
    EXPECT_THROW(static_cast<void>(next.SlotOf("message", 3)), std::out_of_range);
  }
}

TEST(LongMessages, EachLengthArrivesWhole)
{
  for (const int bytes : {10, 11, 12, 15, 16, 9'999, 10'000})
  {
    TestWorld world;
    AddController(world, "long", bytes);
    AddController(world, "short", 10);
    const std::vector<std::uint32_t> receivers{AddFootbot(world, 5, "short")};
    const std::vector<std::uint32_t> senders{AddFootbot(world, 6, "long"), AddFootbot(world, 3, "long")};
    AddFootbot(world, 8, "short");
    TestActuator actuator(world, kType, kImplementation, senders, {{"bytes", std::to_string(bytes)}});
    TestSensor sensor(world, kType, kImplementation, receivers);
    auto& first = actuator.Of<CCI_RangeAndBearingActuator>(0);
    EXPECT_EQ(first.GetNumBytes(), static_cast<unsigned>(bytes));
    const auto send = [&]
    {
      actuator.Commit();
      CheckAttributes(world.Space(), actuator.changes);
      world.Space().SetAttributes(actuator.changes);
      world.Space().SetTick(world.Space().GetTick() + 1);
      sensor.Update();
    };
    const auto& receiver = sensor.Of<CCI_RangeAndBearingSensor>(0);

    const auto message = Numbered(static_cast<std::size_t>(bytes), 1);
    first.SetBytes(message);
    send();
    ASSERT_EQ(receiver.GetAllPackets().size(), 1U);
    EXPECT_EQ(BytesOf(receiver, receiver.GetAllPackets()[0]), message);

    // Two senders have messages of their own. A shorter message than the one before ends with zeros.
    std::vector<std::uint8_t> shorter = Numbered(7, 100);
    first.SetBytes(shorter);
    const auto other = Numbered(static_cast<std::size_t>(bytes), 200);
    actuator.Of<CCI_RangeAndBearingActuator>(1).SetBytes(other);
    send();
    ASSERT_EQ(receiver.GetAllPackets().size(), 2U);
    shorter.resize(static_cast<std::size_t>(bytes), 0);
    for (const auto& packet : receiver.GetAllPackets())
      EXPECT_EQ(BytesOf(receiver, packet), packet.range_m < 1.5 ? shorter : other);

    first.StopSending();
    send();
    ASSERT_EQ(receiver.GetAllPackets().size(), 1U);
    EXPECT_EQ(BytesOf(receiver, receiver.GetAllPackets()[0]), other);
  }
}

TEST(LongMessages, MoreBytesThanAMessageHasAreRefused)
{
  for (const int bytes : {10, 11, 10'000})
  {
    TestWorld world;
    AddController(world, "long", bytes);
    AddFootbot(world, 5, "long");
    TestActuator actuator(world, kType, kImplementation, {0}, {{"bytes", std::to_string(bytes)}});
    auto& sender = actuator.Of<CCI_RangeAndBearingActuator>(0);
    sender.SetBytes(Numbered(static_cast<std::size_t>(bytes), 0));
    EXPECT_EQ(
        test::MessageOf<std::length_error>([&] { sender.SetBytes(Numbered(static_cast<std::size_t>(bytes) + 1, 0)); }),
        "a message of range and bearing has " + std::to_string(bytes) + " bytes, and " + std::to_string(bytes + 1) +
            " are given");
  }
}

TEST(LongMessages, TheFileGivesTenToTenThousandBytes)
{
  const TestWorld registers_the_devices;
  const auto* entry = PluginRegistry<ActuatorBatch>::Instance().Find(kType, kImplementation);
  ASSERT_NE(entry, nullptr);
  const auto mistakes = [&](const std::string& bytes)
  {
    const std::string element = "<range_and_bearing bytes='" + bytes + "'/>";
    std::string text;
    for (const ConfigurationError& mistake :
         MistakesIn(TConfigurationTree(ReadXml(element, "f.xml")), entry->description.parameters, "actuator"))
      text += mistake.what();
    return text;
  };
  for (const char* right : {"10", "11", "9999", "10000"}) EXPECT_EQ(mistakes(right), "");
  for (const char* wrong : {"9", "10001", "0", "-1", "10.5"})
    EXPECT_NE(mistakes(wrong).find("'bytes' of the actuator is"), std::string::npos)
        << wrong << ": " << mistakes(wrong);
  EXPECT_NE(mistakes("10001").find("from 10 to 10000"), std::string::npos) << mistakes("10001");
}

// Values that are not five bytes do not enter the state, in the further slots either.
TEST(LongMessages, NumbersThatAreNoBytesAreNamedWithTheirElement)
{
  TestWorld world;
  AddController(world, "long", 16);
  AddFootbot(world, 5, "long");
  const std::uint32_t last = world.Space().GetEntity(0).SlotOf("message", 4);
  CheckAttribute(world.Space(), last, 0xffffffffff);
  for (const double wrong : {-1.0, 0.5, 0x1p40}) try
    {
      CheckAttribute(world.Space(), last, wrong);
      ADD_FAILURE() << wrong;
    }
    catch (const StateError& error)
    {
      EXPECT_NE(std::string(error.what()).find("the attribute 'message' 4 of"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("2^40 - 1"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace swarmanoid
