// Blocks of recorded states, read again by the letter of recording_writer.h.
#include "visualiser/web/recording_writer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>

#include "common/space/attributes.h"
#include "tests/web/four_entities.h"

namespace swarmanoid
{
namespace
{

class BlockReader
{
public:
  explicit BlockReader(std::string bytes) : bytes_(std::move(bytes)) {}

  bool IsAtEnd() const { return place_ == bytes_.size(); }
  std::uint8_t Byte() { return static_cast<std::uint8_t>(bytes_.at(place_++)); }
  std::string Bytes(std::size_t count)
  {
    EXPECT_LE(place_ + count, bytes_.size());
    place_ += count;
    return bytes_.substr(place_ - count, count);
  }
  std::uint64_t Count()
  {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7)
    {
      const std::uint64_t byte = Byte();
      value += (byte & 127U) << shift;
      if (byte < 128) return value;
    }
  }
  static std::int64_t Number(std::uint64_t count)
  {
    return count % 2 == 0 ? static_cast<std::int64_t>(count / 2) : -static_cast<std::int64_t>(count / 2) - 1;
  }
  std::vector<std::int64_t> Column(bool changes, std::size_t states)
  {
    std::vector<std::int64_t> column{Number(Count())};
    std::int64_t step = 0;
    for (std::size_t state = 1; state < states; ++state)
    {
      if (changes) step += Number(Count());
      column.push_back(column.back() + step);
    }
    return column;
  }
  double Value()
  {
    const std::uint64_t count = Count();
    if (count != 1)
    {
      EXPECT_EQ(count % 2, 0U);
      return static_cast<double>(Number(count / 2));
    }
    float number = 0;
    std::memcpy(&number, Bytes(sizeof number).data(), sizeof number);
    return static_cast<double>(number);
  }

private:
  std::string bytes_;
  std::size_t place_ = 0;
};

struct RecordedState
{
  std::uint64_t tick = 0;
  std::vector<Vector3> positions;
  std::vector<Quaternion> turns;
  std::string colours, lists;
  std::vector<double> attributes;
};

std::vector<RecordedState> StatesIn(const std::string& block, std::size_t entities, std::size_t attributes)
{
  BlockReader reader(block);
  std::vector<RecordedState> states(reader.Count());
  states.at(0).tick = reader.Count();
  for (std::size_t k = 1; k < states.size(); ++k) states[k].tick = states[k - 1].tick + reader.Count();
  for (std::size_t slot = 0; slot < entities; ++slot)
  {
    const unsigned flags = reader.Byte();
    std::vector<std::vector<std::int64_t>> columns;
    for (const unsigned flag : {1U, 2U, 4U}) columns.push_back(reader.Column((flags & flag) != 0, states.size()));
    const bool tilts = (flags & 16U) != 0;
    for (int k = 0; k < (tilts ? 4 : 1); ++k) columns.push_back(reader.Column((flags & 8U) != 0, states.size()));
    for (std::size_t state = 0; state < states.size(); ++state)
    {
      const auto number = [&](std::size_t column) { return static_cast<double>(columns[column][state]); };
      states[state].positions.emplace_back(1e-5 * number(0), 1e-5 * number(1), 1e-5 * number(2));
      states[state].turns.push_back(tilts ? Quaternion(number(6), number(3), number(4), number(5)).normalized()
                                          : QuaternionFromYaw(number(3) / 32767 * kPi));
    }
  }
  states[0].colours = reader.Bytes(4 * entities);
  for (std::size_t state = 1; state < states.size(); ++state)
  {
    states[state].colours = states[state - 1].colours;
    std::uint64_t slot = ~std::uint64_t{0};
    for (std::uint64_t changed = reader.Count(); changed > 0; --changed)
    {
      slot += reader.Count();
      states[state].colours.replace(4 * slot, 4, reader.Bytes(4));
    }
  }
  for (std::size_t state = 0; state < states.size(); ++state)
  {
    if (reader.Byte() == 0)
    {
      states[state].lists = states.at(state - 1).lists;
      continue;
    }
    const std::uint64_t beams = reader.Count(), grips = reader.Count(), rings = reader.Count();
    states[state].lists = reader.Bytes(20 * beams + 8 * grips + 52 * rings);
  }
  std::vector<double> values(attributes, 0);
  for (RecordedState& state : states)
  {
    std::uint64_t number = ~std::uint64_t{0};
    for (std::uint64_t changed = reader.Count(); changed > 0; --changed)
    {
      number += reader.Count();
      values.at(number) = reader.Value();
    }
    state.attributes = values;
  }
  EXPECT_TRUE(reader.IsAtEnd());
  return states;
}

// Returns all attributes that are recorded, in their order.
std::vector<double> RecordedAttributes(const CSwarmanoidSpace& space)
{
  std::vector<double> values;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
    for (const AttributeSpec& spec : AttributesOf(space.GetEntity(e).GetKind()))
      if (std::ranges::find(RecordingWriter::LeftOut(), spec.name) == RecordingWriter::LeftOut().end())
        for (int k = 0; k < spec.count; ++k) values.push_back(space.GetEntity(e).GetAttribute(spec.name, k));
  return values;
}

RecordedState StateOf(const CSwarmanoidSpace& space)
{
  RecordedState state;
  state.tick = space.GetTick();
  for (const std::uint32_t e : space.Movable())
  {
    state.positions.push_back(space.GetPose(e).position);
    state.turns.push_back(space.GetPose(e).orientation);
  }
  const std::string key = FrameWriter(space).WriteKey();
  const std::size_t n = space.Movable().size();
  state.colours = key.substr(40 + 20 * n, 4 * n);
  state.lists = key.substr(40 + 24 * n);
  state.attributes = RecordedAttributes(space);
  return state;
}

void ExpectSame(const RecordedState& read, const RecordedState& written)
{
  EXPECT_EQ(read.tick, written.tick);
  ASSERT_EQ(read.positions.size(), written.positions.size());
  for (std::size_t k = 0; k < read.positions.size(); ++k)
  {
    EXPECT_LE((read.positions[k] - written.positions[k]).cwiseAbs().maxCoeff(), 0.51e-5) << k;
    EXPECT_LT(read.turns[k].angularDistance(written.turns[k]), 2e-4) << "entity " << k << " at " << read.tick;
  }
  EXPECT_EQ(read.colours, written.colours);
  EXPECT_EQ(read.lists, written.lists);
  ASSERT_EQ(read.attributes.size(), written.attributes.size());
  for (std::size_t k = 0; k < read.attributes.size(); ++k)
    EXPECT_EQ(static_cast<float>(read.attributes[k]), static_cast<float>(written.attributes[k])) << k;
}

TEST(RecordingWriter, EveryStateOfABlockIsReadAgain)
{
  FourEntities world;
  CSwarmanoidSpace& space = world.space;
  RecordingWriter writer(space);
  EXPECT_TRUE(writer.IsEmpty());
  std::mt19937 random(7);
  const auto number = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  std::uint64_t tick = 3;
  for (int block = 0; block < 20; ++block)
  {
    std::vector<RecordedState> written;
    const std::uint64_t first = tick;
    for (int k = 0; k < 12; ++k, tick += 1 + random() % 300)
    {
      space.SetTick(tick);
      Pose pose = space.GetPose(0);
      pose.position += Vector3(number(-0.1, 0.1), number(-0.1, 0.1), 0);
      pose.orientation = pose.orientation * QuaternionFromYaw(number(0, 2));  // it turns on, beyond a full turn
      space.SetPose(0, pose);
      if (block % 3 == 1)
        space.SetPose(1, {{2, 2, number(1, 2)}, Quaternion(Eigen::AngleAxisd(number(0, 1), Vector3::UnitY()))});
      switch (random() % 6)
      {
        case 0:
          space.GetEntity(0).SetAttribute("led", static_cast<double>(random() & 0xffffffU),
                                          static_cast<int>(random() % 12));
          break;
        case 1:
          space.GetEntity(1).SetAttribute("laser", static_cast<double>(random() % 2));
          break;
        case 2:
          space.GetEntity(0).SetAttribute("gripped", static_cast<double>(random() % 3));
          break;
        case 3:
          space.GetEntity(0).SetAttribute("turret_angle", number(-3, 3));
          break;
        case 4:
          space.GetEntity(2).SetAttribute("colour", static_cast<double>(random() & 0xffffffU));
          break;
        default:
          break;
      }
      writer.Add();
      written.push_back(StateOf(space));
    }
    EXPECT_FALSE(writer.IsEmpty());
    EXPECT_EQ(writer.FirstTick(), first);
    const std::vector<RecordedState> read =
        StatesIn(writer.TakeBlock(), space.Movable().size(), RecordedAttributes(space).size());
    EXPECT_TRUE(writer.IsEmpty());
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t k = 0; k < read.size(); ++k) ExpectSame(read[k], written[k]);
  }
}

TEST(RecordingWriter, AttributesAreWholeNumbersOrFloats)
{
  FourEntities world;
  CSwarmanoidSpaceEntity& robot = world.space.GetEntity(0);
  for (const double value : {0.0, 1.0, -1.0, 63.0, -64.0, 64.0, 0.5, -2.25, 268435456.0, -268435456.0, 1e12, -1e30})
  {
    robot.SetAttribute("turret_angle", value);
    RecordingWriter writer(world.space);
    writer.Add();
    const RecordedState state = StatesIn(writer.TakeBlock(), 3, RecordedAttributes(world.space).size()).at(0);
    ExpectSame(state, StateOf(world.space));
    EXPECT_TRUE(std::ranges::any_of(state.attributes,
                                    [&](double read) { return static_cast<float>(read) == static_cast<float>(value); }))
        << value;
  }
}

TEST(RecordingWriter, WhatStandsStillTakesNoBytes)
{
  FourEntities world;
  RecordingWriter writer(world.space);
  const auto bytes = [&](int states)
  {
    for (int k = 0; k < states; ++k)
    {
      world.space.SetTick(world.space.GetTick() + 1);
      writer.Add();
    }
    return writer.TakeBlock().size();
  };
  // A further state has a byte each for its tick, its changed colours, its lists and its changed attributes.
  const std::size_t one = bytes(1);
  EXPECT_EQ(bytes(2), one + 4);
  EXPECT_EQ(bytes(100), one + 4 * 99);
}

TEST(RecordingWriter, BytesOfDevicesAreLeftOut)
{
  EXPECT_THAT(RecordingWriter::LeftOut(), testing::UnorderedElementsAre("message", "radio", "report", "instruction"));
  FourEntities world;
  world.space.GetEntity(0).SetAttribute("message", 1);
  RecordingWriter writer(world.space);
  writer.Add();
  const RecordedState state = StatesIn(writer.TakeBlock(), 3, RecordedAttributes(world.space).size()).at(0);
  ExpectSame(state, StateOf(world.space));
}

TEST(RecordingWriter, BlocksAreShorterInLargerSwarms)
{
  const auto states_of_block = [](int robots)
  {
    Experiment experiment;
    experiment.arena_size = {100, 100, 1};
    for (int i = 0; i < robots; ++i)
      experiment.entities.push_back(test::Entity(EntityKind::kFootbot, std::to_string(i), {i * 0.01, 1, 0}));
    CSwarmanoidSpace space(experiment);
    RecordingWriter writer(space);
    int states = 0;
    for (; !writer.IsFull(); ++states)
    {
      space.SetTick(static_cast<std::uint64_t>(states));
      writer.Add();
    }
    return states;
  };
  EXPECT_EQ(states_of_block(0), 256);
  EXPECT_EQ(states_of_block(1), 256);
  EXPECT_EQ(states_of_block(2048), 128) << "262,144 poses";
}

}  // namespace
}  // namespace swarmanoid
