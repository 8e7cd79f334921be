// Messages have the bytes of the types that fastddsgen makes from the IDL.
#include <gtest/gtest.h>

#include <limits>

#include "common/bus/dds/for_tests.h"
#include "common/bus/topics/message_type.h"
#include "swarmanoid.h"
#include "swarmanoidPubSubTypes.h"
#include "tests/world/random_message.h"

namespace swarmanoid
{
namespace
{

constexpr int kRounds = 100;

template <class... Parts>
std::string OurBytes(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '?');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

// Returns what the type of fastddsgen reads from the bytes.
template <class Support, class Wire>
Wire GeneratedRead(const std::string& bytes)
{
  static Support support;  // the largest size of a type takes long to count
  Payload payload(static_cast<std::uint32_t>(bytes.size()));
  std::memcpy(payload.data, bytes.data(), bytes.size());
  payload.length = static_cast<std::uint32_t>(bytes.size());
  Wire wire;
  EXPECT_TRUE(test::GeneratedRead(support, payload, &wire));
  return wire;
}

template <class Support, class Wire>
std::string GeneratedBytes(Wire& wire)
{
  static Support support;
  Payload payload(100000);
  EXPECT_TRUE(test::GeneratedWrite(support, &wire, payload));
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

template <class Message, class Support, class Wire>
void ExpectSameOfTick()
{
  RandomMessage random(1);
  for (int round = 0; round < kRounds; ++round)
  {
    MessageHeader header;
    Message message;
    random.Fill(header, message);
    const std::string bytes = OurBytes(header, message);
    Wire wire = GeneratedRead<Support, Wire>(bytes);
    EXPECT_EQ(wire.header().run(), header.run);
    EXPECT_EQ(wire.header().incarnation(), header.incarnation);
    EXPECT_EQ(GeneratedBytes<Support>(wire), bytes);
    MessageHeader seen;
    Message read;
    const auto choose = [&](const MessageHeader&) { return &read; };
    EXPECT_EQ(ReadTickPayload<Message>(bytes, seen, choose, [](const MessageHeader&, const Message&) {}), &read);
    EXPECT_EQ(OurBytes(seen, read), bytes);
  }
}

template <class Message, class Support, class Wire>
void ExpectSame()
{
  RandomMessage random(2);
  for (int round = 0; round < kRounds; ++round)
  {
    Message message;
    random.Fill(message);
    const std::string bytes = OurBytes(message);
    Wire wire = GeneratedRead<Support, Wire>(bytes);
    if constexpr (requires { message.run; })
    {
      EXPECT_EQ(wire.run(), message.run);
    }
    EXPECT_EQ(GeneratedBytes<Support>(wire), bytes);
    Message read;
    ReadPayload(bytes, read);
    EXPECT_EQ(OurBytes(read), bytes);
  }
}

#define TEST_OF_TICK(MESSAGE, TOPIC) \
  TEST(BytesOfTheIdl, TOPIC) { ExpectSameOfTick<MESSAGE, wire::TOPIC##PubSubType, wire::TOPIC>(); }
#define TEST_OF_OTHER(MESSAGE, TOPIC) \
  TEST(BytesOfTheIdl, TOPIC) { ExpectSame<MESSAGE, wire::TOPIC##PubSubType, wire::TOPIC>(); }
SWARMANOID_HOT_MESSAGES(TEST_OF_TICK)
SWARMANOID_COLD_MESSAGES(TEST_OF_OTHER)

TEST(MessageFields, AreThoseOfTheIdl)
{
  SpaceState state;
  MessageHeader header{1, 2, 3, true, 4, false};
  state.last = true;
  state.poses = {1, 2, 3, 0, 0, 0, 1};
  state.attributes.Add(7, 0.5);
  state.moved = {5};
  state.drawing.texts = {"here"};
  const auto wire = GeneratedRead<wire::SpaceStatePubSubType, wire::SpaceState>(OurBytes(header, state));
  EXPECT_EQ(wire.header().tick(), 2U);
  EXPECT_EQ(wire.header().source(), 3U);
  EXPECT_EQ(wire.flags(), wire::FLAG_LAST | wire::FLAG_REPEATED);
  EXPECT_EQ(wire.poses(), state.poses);
  EXPECT_EQ(wire.attributes().slots(), state.attributes.slots);
  EXPECT_EQ(wire.attributes().values(), state.attributes.values);
  EXPECT_EQ(wire.moved(), state.moved);
  EXPECT_EQ(wire.drawing().texts(), state.drawing.texts);

  const JoinMessage join{"host:1", kProtocolVersion, 7, "engine 'ground'", true, 3, "there", 0.5};
  const auto wire_join = GeneratedRead<wire::JoinPubSubType, wire::Join>(OurBytes(join));
  EXPECT_EQ(wire_join.process(), join.process);
  EXPECT_EQ(wire_join.protocol(), wire::PROTOCOL_VERSION);
  EXPECT_EQ(wire_join.name(), join.name);
  EXPECT_EQ(wire_join.machine(), join.machine);
}

// Every set of columns that are the same for all entities; with all seven one goes whole, and with one entity none is
// shorter.
TEST(MessagePoses, HaveUniformColumnsAsOneNumber)
{
  RandomMessage random(4);
  for (std::uint32_t uniform = 0; uniform < 128; ++uniform)
    for (const std::size_t entities : {0U, 1U, 2U, 5U})
    {
      EngineUpdate update;
      update.poses = random.Poses(entities, uniform);
      const std::uint32_t shortened = entities < 2 ? 0 : uniform == 127 ? 63 : uniform;
      std::vector<double> sent;
      for (std::size_t k = 0; k < update.poses.size(); ++k)
        if (k % entities == 0 || (shortened >> k / entities & 1U) == 0) sent.push_back(update.poses[k]);
      const std::string bytes = OurBytes(MessageHeader(), update);
      const auto wire = GeneratedRead<wire::EngineUpdatePubSubType, wire::EngineUpdate>(bytes);
      EXPECT_EQ(wire.poses(), sent);
      EXPECT_EQ(wire.flags(), shortened * wire::FLAG_UNIFORM_X);
    }
}

// Zero and minus zero are two values.
TEST(MessagePoses, TellTheSignOfZero)
{
  EXPECT_EQ(UniformColumns({0.0, -0.0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2}), 0b0111110U);
}

TEST(MessagePoses, MustFitTheFlags)
{
  const std::vector<double> numbers(9, 1.0);
  std::vector<double> poses;
  const auto spread = [&](std::size_t count, std::uint32_t uniform)
  { return SpreadColumns(reinterpret_cast<const char*>(numbers.data()), count, uniform, poses); };
  EXPECT_EQ(spread(9, 127), ColumnMistake::kLength);  // how many entities?
  EXPECT_EQ(spread(9, 0b1111000), ColumnMistake::kLength);
  EXPECT_EQ(spread(9, 0b0011111), ColumnMistake::kNone);
  EXPECT_EQ(poses.size(), 14U);
  EXPECT_EQ(spread(3, 0b0000111), ColumnMistake::kLength);
}

// A reader keeps the memory of the message before.
TEST(MessagePoses, ReplaceThoseOfAnEarlierMessage)
{
  RandomMessage random(5);
  std::vector<double> kept;
  for (std::uint32_t uniform = 0; uniform < 128; ++uniform)
    for (const std::size_t entities : {5U, 2U, 5U, 1U})
    {
      const std::vector<double> poses = random.Poses(entities, uniform);
      const std::uint32_t shortened = UniformColumns(poses);
      std::vector<double> sent;
      for (std::size_t k = 0; k < poses.size(); ++k)
        if (k % entities == 0 || (shortened >> k / entities & 1U) == 0) sent.push_back(poses[k]);
      const auto spread = [&]
      { return SpreadColumns(reinterpret_cast<const char*>(sent.data()), sent.size(), shortened, kept); };
      // The second time the columns have these numbers already.
      for (int k = 0; k < 2; ++k) EXPECT_EQ(spread(), ColumnMistake::kNone);
      EXPECT_EQ(kept, poses);
      sent.front() = std::numeric_limits<double>::infinity();
      EXPECT_EQ(spread(), ColumnMistake::kNotFinite);
    }
}

// Fast DDS of an earlier release and other vendors tell instances by the same hash.
TEST(MessageKeys, AreThoseOfTheIdl)
{
  InstanceHandle ours;
  InstanceHandle theirs;
  const JoinMessage join{"some-machine.example:12345", kProtocolVersion, 7, "engine 'ground'", true};
  ColdCall<JoinMessage> call;
  call.out = &join;
  ASSERT_TRUE(ColdType<JoinMessage>().KeyOf(&call, ours));
  wire::Join wire_join;
  wire_join.process(join.process);
  wire::JoinPubSubType join_type;
  ASSERT_TRUE(test::GeneratedKey(join_type, &wire_join, theirs));
  EXPECT_EQ(ours, theirs);

  const ViewRequestMessage request{"x:1", 7, 30, false, {}};
  ColdCall<ViewRequestMessage> client_request;
  client_request.out = &request;
  ASSERT_TRUE(ColdType<ViewRequestMessage>().KeyOf(&client_request, ours));
  wire::ViewRequest wire_request;
  wire_request.client("x:1");
  wire::ViewRequestPubSubType request_type;
  ASSERT_TRUE(test::GeneratedKey(request_type, &wire_request, theirs));
  EXPECT_EQ(ours, theirs);
  EXPECT_FALSE(test::IsKeyed(ColdType<LeaveMessage>()));
  EXPECT_FALSE(test::IsKeyed(wire::LeavePubSubType()));
}

}  // namespace
}  // namespace swarmanoid
