// The hand-written type support must put the same bytes on the wire as what fastddsgen makes from the IDL.
#include "common/bus/hot_type.h"

#include <gtest/gtest.h>

#include "swarmanoid.h"
#include "swarmanoidPubSubTypes.h"

namespace swarmanoid
{
namespace
{

using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

SpaceState SampleState()
{
  SpaceState state;
  state.tick = 0x1122334455ULL;
  state.last = true;
  state.poses = {1.5, -2.25, 1e300, -0.0, 5, 6, 7};
  state.attributes.Add(3, 0.5);
  state.attributes.Add(77, 16711680);
  state.attributes.Add(78, -1);
  state.moved = {4, 9};
  return state;
}

template <class Support, class Wire>
std::string GeneratedBytes(Wire& wire)
{
  Support support;
  Payload payload(1000);
  EXPECT_TRUE(support.serialize(&wire, &payload));
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

template <class Message>
std::string OurBytes(const MessageHeader& header, const Message& message)
{
  HotType<Message> type(900);
  Payload payload(904);
  HotWrite<Message> call{&header, &message};
  EXPECT_TRUE(type.serialize(&call, &payload));
  EXPECT_EQ(type.getSerializedSizeProvider(&call)(), payload.length);
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

TEST(HotType, SpaceStateHasTheBytesOfItsIdlType)
{
  const SpaceState state = SampleState();
  wire::SpaceState wire;
  wire.run(0xabcdef0123456789ULL);
  wire.tick(state.tick);
  wire.source(0);
  wire.poses(state.poses);
  wire.flags(wire::FLAG_LAST | wire::FLAG_REPEATED);
  wire.attribute_values(state.attributes.values);
  wire.attribute_slots(state.attributes.slots);
  wire.moved(state.moved);
  EXPECT_EQ(OurBytes<SpaceState>({0xabcdef0123456789ULL, state.tick, 0, true}, state),
            GeneratedBytes<wire::SpaceStatePubSubType>(wire));
}

TEST(HotType, CommandsUpdatesFramesAndDrawnHaveTheBytesOfTheirIdlTypes)
{
  const MessageHeader header{7, 8, 9, false};
  ControlCommands commands;
  commands.values = {1, 2, 3};
  commands.attributes.Add(5, 0.25);
  wire::ControlCommands wire_commands;
  wire_commands.run(7);
  wire_commands.tick(8);
  wire_commands.source(9);
  wire_commands.values(commands.values);
  wire_commands.attribute_values(commands.attributes.values);
  wire_commands.attribute_slots(commands.attributes.slots);
  wire_commands.flags(0);
  EXPECT_EQ(OurBytes(header, commands), GeneratedBytes<wire::ControlCommandsPubSubType>(wire_commands));

  EngineUpdate update;
  update.poses = {4, 5, 6, 7, 8, 9, 10};
  wire::EngineUpdate wire_update;
  wire_update.run(7);
  wire_update.tick(8);
  wire_update.source(9);
  wire_update.poses(update.poses);
  wire_update.flags(0);
  EXPECT_EQ(OurBytes(header, update), GeneratedBytes<wire::EngineUpdatePubSubType>(wire_update));

  SensorFrame frame;
  frame.values = {0.125};
  wire::SensorFrame wire_frame;
  wire_frame.run(7);
  wire_frame.tick(8);
  wire_frame.source(9);
  wire_frame.values(frame.values);
  EXPECT_EQ(OurBytes(header, frame), GeneratedBytes<wire::SensorFramePubSubType>(wire_frame));

  wire::Drawn wire_drawn;
  wire_drawn.run(7);
  wire_drawn.tick(8);
  wire_drawn.source(9);
  wire_drawn.flags(wire::FLAG_TERMINATE);
  EXPECT_EQ(OurBytes(header, DrawnMessage{true}), GeneratedBytes<wire::DrawnPubSubType>(wire_drawn));
}

TEST(HotType, ReadsBackWhatItWrote)
{
  const SpaceState state = SampleState();
  const MessageHeader header{1, state.tick, 0, true};
  HotType<SpaceState> type(900);
  Payload payload(904);
  HotWrite<SpaceState> write{&header, &state};
  ASSERT_TRUE(type.serialize(&write, &payload));

  SpaceState place;
  const std::function<SpaceState*(const MessageHeader&)> choose = [&](const MessageHeader& seen)
  {
    EXPECT_EQ(seen.run, 1U);
    EXPECT_EQ(seen.tick, state.tick);
    return &place;
  };
  HotRead<SpaceState> read{&choose, {}, nullptr};
  ASSERT_TRUE(type.deserialize(&payload, &read));
  EXPECT_EQ(read.message, &place);
  EXPECT_TRUE(read.header.repeated);
  EXPECT_EQ(place.tick, state.tick);
  EXPECT_TRUE(place.last);
  EXPECT_EQ(place.poses, state.poses);
  EXPECT_EQ(place.attributes.slots, state.attributes.slots);
  EXPECT_EQ(place.attributes.values, state.attributes.values);
  EXPECT_EQ(place.moved, state.moved);
}

TEST(HotType, RefusesCutMessagesAndThoseLargerThanItsCapacity)
{
  const SpaceState state = SampleState();
  const MessageHeader header{1, 2, 0, false};
  HotWrite<SpaceState> write{&header, &state};
  Payload small(60);
  EXPECT_FALSE(HotType<SpaceState>(56).serialize(&write, &small));

  HotType<SpaceState> type(900);
  Payload payload(904);
  ASSERT_TRUE(type.serialize(&write, &payload));
  SpaceState place;
  const std::function<SpaceState*(const MessageHeader&)> choose = [&](const MessageHeader&) { return &place; };
  const std::uint32_t whole = payload.length;
  for (std::uint32_t length = 0; length < whole; ++length)
  {
    payload.length = length;
    HotRead<SpaceState> read{&choose, {}, nullptr};
    EXPECT_FALSE(type.deserialize(&payload, &read)) << length;
  }
  payload.length = whole;
}

TEST(Protocol, VersionInTheCodeIsThatOfTheIdl) { EXPECT_EQ(kProtocolVersion, wire::PROTOCOL_VERSION); }

}  // namespace
}  // namespace swarmanoid
