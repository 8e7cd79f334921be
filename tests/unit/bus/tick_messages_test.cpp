// The messages of a tick have the bytes of the types that are made from the IDL.
#include <gtest/gtest.h>

#include "tests/unit/bus/random_messages.h"

namespace swarmanoid
{
namespace
{

// Every set of columns that are the same for all entities; with all seven one goes whole, and with one entity none is
// shorter.
TEST(MessageBytes, OfPosesHaveUniformColumnsAsOneNumber)
{
  Random random(4);
  for (std::uint32_t uniform = 0; uniform < 128; ++uniform)
    for (const std::size_t entities : {0U, 1U, 2U, 5U})
    {
      UpdateMessage update;
      std::vector<double> sent;
      const std::uint32_t shortened = entities < 2 ? 0 : uniform == 127 ? 63 : uniform;
      for (std::uint32_t k = 0; k < 7; ++k)
      {
        const double same = k == 2 ? -0.0 : random.Real();
        for (std::size_t e = 0; e < entities; ++e)
        {
          update.poses.push_back(uniform >> k & 1U ? same : same + 1 + static_cast<double>(e * (4 - e)));
          if (e == 0 || (shortened >> k & 1U) == 0) sent.push_back(update.poses.back());
        }
      }
      const MessageHeader header = RandomHeader(random);
      wire::EngineUpdate wire_update;
      wire_update.poses(sent);
      wire_update.flags(FlagsOf(false, header.repeated) | shortened * wire::FLAG_UNIFORM_X);
      ExpectSame<wire::EngineUpdatePubSubType>(header, update, wire_update);
    }
}

// Zero and minus zero are two values.
TEST(MessageBytes, OfPosesTellTheSignOfZero)
{
  EXPECT_EQ(UniformColumns({0.0, -0.0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2}), 0b0111110U);
}

TEST(MessageBytes, OfPosesMustFitTheFlags)
{
  std::vector<double> numbers(9, 1.0);
  EXPECT_FALSE(SpreadColumns(numbers, 127));  // how many entities?
  EXPECT_FALSE(SpreadColumns(numbers, 0b1111000));
  EXPECT_TRUE(SpreadColumns(numbers, 0b0011111));
  EXPECT_EQ(numbers.size(), 14U);
  std::vector<double> few(3, 1.0);
  EXPECT_FALSE(SpreadColumns(few, 0b0000111));
}

TEST(MessageBytes, OfATickAreThoseOfTheIdl)
{
  Random random(1);
  for (int round = 0; round < kRounds; ++round)
  {
    const MessageHeader header = RandomHeader(random);
    SpaceState state;
    state.last = random.Flag();
    state.poses = random.Reals();
    state.attributes = RandomChanges(random);
    state.moved = random.Ascending();
    state.drawing = random.Drawn();
    wire::SpaceState wire_state;
    wire_state.poses(state.poses);
    wire_state.flags(FlagsOf(state.last, header.repeated) | (header.save ? wire::FLAG_SAVE : 0U));
    wire_state.attribute_values(state.attributes.values);
    wire_state.attribute_slots(state.attributes.slots);
    wire_state.moved(state.moved);
    SetDrawing(state.drawing, wire_state);
    ExpectSame<wire::SpaceStatePubSubType>(header, state, wire_state);

    LocalState local;
    local.last = state.last;
    local.poses = state.poses;
    local.attributes = state.attributes;
    local.entities = random.Ascending();
    local.near = random.Ascending();
    local.moved = state.moved;
    wire::LocalState wire_local;
    wire_local.poses(local.poses);
    wire_local.flags(wire_state.flags());
    wire_local.attribute_values(local.attributes.values);
    wire_local.attribute_slots(local.attributes.slots);
    wire_local.entities(local.entities);
    wire_local.near(local.near);
    wire_local.moved(local.moved);
    ExpectSame<wire::LocalStatePubSubType>(header, local, wire_local);

    ControlCommands commands;
    commands.values = random.Reals();
    commands.attributes = RandomChanges(random);
    commands.faults.robots = random.Ascending();
    for (std::size_t k = 0; k < commands.faults.robots.size(); ++k)
      commands.faults.kinds.push_back(static_cast<FaultKind>(1 + k % 3));
    commands.faults.texts = random.Bytes();
    wire::ControlCommands wire_commands;
    wire_commands.values(commands.values);
    wire_commands.flags(FlagsOf(false, header.repeated));
    wire_commands.attribute_values(commands.attributes.values);
    wire_commands.attribute_slots(commands.attributes.slots);
    wire_commands.fault_robots(commands.faults.robots);
    for (const FaultKind kind : commands.faults.kinds)
      wire_commands.fault_kinds().push_back(static_cast<std::uint32_t>(kind));
    wire_commands.fault_texts().assign(commands.faults.texts.begin(), commands.faults.texts.end());
    ExpectSame<wire::ControlCommandsPubSubType>(header, commands, wire_commands);

    UpdateMessage update;
    update.poses = random.Reals();
    update.attributes = RandomChanges(random);
    update.recorded = random.Reals();
    wire::EngineUpdate wire_update;
    wire_update.poses(update.poses);
    wire_update.flags(FlagsOf(false, header.repeated));
    wire_update.attribute_values(update.attributes.values);
    wire_update.attribute_slots(update.attributes.slots);
    wire_update.recorded(update.recorded);
    ExpectSame<wire::EngineUpdatePubSubType>(header, update, wire_update);

    SensorFrame frame;
    frame.values = random.Reals();
    wire::SensorFrame wire_frame;
    wire_frame.values(frame.values);
    ExpectSame<wire::SensorFramePubSubType>(header, frame, wire_frame);

    const auto expect_region =
        [&]<class Support, class Message, class Wire>(Support*, Message message, Wire wire_message)
    {
      message.epoch = random.Number32();
      message.number = random.Number32();
      for (std::uint32_t part = 0; part < random.Number32() % 4; ++part)
      {
        message.sizes.push_back(random.Number32() % 20);
        for (std::uint32_t k = 0; k < message.sizes.back(); ++k)
          message.bytes.push_back(static_cast<char>(random.Number32()));
      }
      wire_message.epoch(message.epoch);
      wire_message.number(message.number);
      wire_message.flags(FlagsOf(false, header.repeated));
      wire_message.sizes(message.sizes);
      wire_message.bytes({message.bytes.begin(), message.bytes.end()});
      ExpectSame<Support>(header, message, wire_message);
    };
    expect_region(static_cast<wire::RegionTaskPubSubType*>(nullptr), RegionTaskMessage(), wire::RegionTask());
    expect_region(static_cast<wire::RegionHaloPubSubType*>(nullptr), RegionHaloMessage(), wire::RegionHalo());
    expect_region(static_cast<wire::RegionResultPubSubType*>(nullptr), RegionResultMessage(), wire::RegionResult());

    const DrawnMessage drawn{random.Flag()};
    wire::Drawn wire_drawn;
    wire_drawn.flags(FlagsOf(drawn.terminate, header.repeated));
    ExpectSame<wire::DrawnPubSubType>(header, drawn, wire_drawn);
  }
}

}  // namespace
}  // namespace swarmanoid
