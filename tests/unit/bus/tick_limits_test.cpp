// The messages of a tick are checked against the experiment: lengths, slots, entities and senders.
#include "common/bus/membership/tick_limits.h"
#include "common/space/space.h"

#include <gmock/gmock.h>

#include "common/bus/bus.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

// Three robots, the last one of the second engine; one controller host.
Experiment ThreeRobots()
{
  Experiment experiment;
  experiment.arena_size = {10, 10, 1};
  experiment.engines.resize(2);
  for (int k = 0; k < 3; ++k)
    test::Add(experiment, test::Entity(EntityKind::kFootbot, std::string(1, static_cast<char>('a' + k))), k / 2);
  return experiment;
}

class LimitsOfATick : public testing::Test
{
protected:
  // Returns the reason of the refusal; empty if the message is accepted.
  template <class Message>
  std::string Refusal(const Message& message, std::uint32_t source = 0) const
  {
    return test::MessageOf<BadMessage>([&] { limits_.Check({1, 1, source, false}, message); });
  }
  SpaceState State() const
  {
    SpaceState state;
    state.poses.resize(7 * 3);
    return state;
  }
  std::uint32_t Slots() const { return static_cast<std::uint32_t>(space_.Attributes().size()); }

  const Experiment experiment_ = ThreeRobots();
  const CSwarmanoidSpace space_{experiment_};
  const TickLimits limits_{space_, MakeAssignment(experiment_, 1), false};
};

TEST_F(LimitsOfATick, PosesAreAsManyAsTheirEngineOwns)
{
  for (const std::uint32_t engine : {0U, 1U})
    for (const std::size_t robots : {0U, 1U, 2U, 3U})
    {
      EngineUpdate update;
      update.poses.resize(7 * robots);
      EXPECT_EQ(Refusal(update, engine).empty(), robots == 2 - engine) << engine << " " << robots;
    }
  EXPECT_THAT(Refusal(EngineUpdate(), 2), HasSubstr("source: there is no number 2"));
  SpaceState state = State();
  EXPECT_EQ(Refusal(state), "");
  EXPECT_THAT(Refusal(state, 1), HasSubstr("source: the space server is number 0"));
  state.poses.pop_back();
  EXPECT_THAT(Refusal(state), HasSubstr("poses: it has 20 numbers, not 21"));
}

TEST_F(LimitsOfATick, TheEntitiesOfAPartAscendAndHaveOnePoseEach)
{
  LocalState part;
  EXPECT_EQ(Refusal(part), "");
  part.entities = {0, 2};
  EXPECT_THAT(Refusal(part), HasSubstr("poses: it has 0 numbers, not 14"));
  part.poses.resize(14);
  EXPECT_EQ(Refusal(part), "");
  for (const std::vector<std::uint32_t>& wrong : {std::vector<std::uint32_t>{2, 0}, {1, 1}, {1, 99}})
  {
    part.entities = wrong;
    EXPECT_THAT(Refusal(part), HasSubstr("does not ascend, or cannot move")) << wrong[1];
  }
  part.entities = {0, 2};
  part.near = {7};
  EXPECT_EQ(Refusal(part), "");
  part.near = {7, 0};
  EXPECT_THAT(Refusal(part), HasSubstr("near: it has 2 numbers, not 1"));
  part.near.clear();
  part.moved = {99};
  EXPECT_THAT(Refusal(part), HasSubstr("moved: entity 99"));
  part.moved.clear();
  part.attributes.Add(Slots(), 0);
  EXPECT_THAT(Refusal(part), HasSubstr("attributes.slots: there is no slot"));
}

TEST_F(LimitsOfATick, SlotsEndWithTheLastOne)
{
  SpaceState state = State();
  ControlCommands commands;
  EngineUpdate update;
  update.poses.resize(7 * 2);
  for (AttributeChanges* changes : {&state.attributes, &commands.attributes, &update.attributes})
    changes->Add(Slots() - 1, 0);
  EXPECT_EQ(Refusal(state), "");
  EXPECT_EQ(Refusal(commands), "");
  EXPECT_EQ(Refusal(update), "");
  for (AttributeChanges* changes : {&state.attributes, &commands.attributes, &update.attributes})
    changes->Add(Slots(), 0);
  const auto refused = HasSubstr("attributes.slots: there is no slot");
  EXPECT_THAT(Refusal(state), refused);
  EXPECT_THAT(Refusal(commands), refused);
  EXPECT_THAT(Refusal(update), refused);
}

// No host commands these robots.
TEST_F(LimitsOfATick, WhatEnginesRecordHasTheLengthOfTheRun)
{
  EngineUpdate update;
  update.poses.resize(7 * 2);
  EXPECT_EQ(Refusal(update), "");
  update.recorded = {0.5};
  EXPECT_THAT(Refusal(update), HasSubstr("recorded: it has 1 numbers, not 0"));

  Assignment assignment = MakeAssignment(experiment_, 1);
  assignment.engines[0].command_size = 4;
  assignment.engines[0].sensor_size = 1;
  for (const bool recorded : {true, false})
  {
    const TickLimits limits(space_, assignment, recorded);
    for (const std::size_t numbers : {0U, 4U, 5U, 6U})
    {
      update.recorded.resize(numbers);
      const bool right = numbers == (recorded ? 5U : 0U);
      if (right)
        EXPECT_NO_THROW(limits.Check(MessageHeader{1, 1, 0, false}, update)) << numbers;
      else
        EXPECT_THROW(limits.Check(MessageHeader{1, 1, 0, false}, update), BadMessage) << numbers;
    }
  }
}

// A run without drawings in its states needs no memory for them.
TEST_F(LimitsOfATick, DrawingsAreOfRunsWithFunctionsAndVisualisers)
{
  SpaceState state = State();
  state.drawing.Segment({0, 0, 0}, {1, 0, 0});
  EXPECT_THAT(Refusal(state), HasSubstr("shapes: nothing draws in this run"));
  Experiment experiment = ThreeRobots();
  experiment.functions.emplace_back();
  experiment.visualisations.emplace_back();
  const CSwarmanoidSpace space(experiment);
  const TickLimits limits(space, MakeAssignment(experiment, 1), false);
  EXPECT_NO_THROW(limits.Check(MessageHeader{1, 1, 0, false}, state));
  EXPECT_GT(limits.StateBytes(), limits_.StateBytes() + 4 * Drawing::kMostNumbers);
}

TEST_F(LimitsOfATick, DrawingsAreChecked)
{
  SpaceSnapshot view;
  view.poses.resize(7 * 3);
  view.attributes.resize(Slots());
  const auto refusal = [&]() -> std::string { return test::MessageOf<BadMessage>([&] { limits_.Check(view); }); };
  Drawing good;
  const Vector3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  good.Points(corners);
  good.Polyline(corners);
  good.Polygon(corners);
  good.Arrow({0, 0, 0}, {1, 1, 1});
  good.InFrameOf(2);
  good.Circle({}, 1);
  good.Disc({}, 1);
  good.Box({}, {1, 2, 3});
  good.Cylinder({}, 0.5, 1);
  good.Text({0, 0, 1}, "text");
  view.drawing = good;
  EXPECT_EQ(refusal(), "");
  const std::pair<const char*, std::function<void(Drawing&)>> mistakes[] = {
      {"there is no kind 11", [](Drawing& d) { d.shapes[0].kind = static_cast<DrawnShape::Kind>(11); }},
      {"there is no entity 3 of 3", [](Drawing& d) { d.shapes.back().frame = 4; }},
      {"sixteenths of a pixel", [](Drawing& d) { d.shapes[0].width_16 = 1U << 31U; }},
      {"has 8 numbers", [](Drawing& d) { d.shapes[0].count = 8; }},
      {"fewer numbers", [](Drawing& d) { d.shapes[1].count = ~0U; }},
      {"has 9 numbers", [](Drawing& d) { d.shapes[4].count = 9; }},
      {"fewer numbers", [](Drawing& d) { d.numbers.pop_back(); }},
      {"more numbers", [](Drawing& d) { d.numbers.push_back(0); }},
      {"not finite", [](Drawing& d) { d.numbers[1] = std::numeric_limits<float>::quiet_NaN(); }},
      {"not finite", [](Drawing& d) { d.numbers[1] = 1e20F; }},
      {"no unit quaternion", [](Drawing& d) { d.numbers[9 + 9 + 9 + 6 + 6] = 2; }},
      {"a size is negative", [](Drawing& d) { d.numbers[9 + 9 + 9 + 6 + 7] = -1; }},
      {"not as many texts", [](Drawing& d) { d.texts.clear(); }},
      {"a text is too long", [](Drawing& d) { d.texts[0].resize(1000, 'a'); }},
      {"texts are more than", [](Drawing& d) { d.texts.resize(Drawing::kMostTexts + 1); }},
      {"shapes are more than", [](Drawing& d) { d.shapes.resize(Drawing::kMostShapes + 1); }},
      {"numbers are more than", [](Drawing& d) { d.numbers.resize(Drawing::kMostNumbers + 1); }},
  };
  for (const auto& [said, spoil] : mistakes)
  {
    view.drawing = good;
    spoil(view.drawing);
    EXPECT_THAT(refusal(), HasSubstr(said));
    EXPECT_THAT(refusal(), HasSubstr("shapes: "));
  }
}

TEST_F(LimitsOfATick, EntitiesThatMovedExistAndAscend)
{
  SpaceState state = State();
  for (const std::vector<std::uint32_t>& good : {std::vector<std::uint32_t>{}, {0}, {2}, {0, 1, 2}})
  {
    state.moved = good;
    EXPECT_EQ(Refusal(state), "");
  }
  for (const std::vector<std::uint32_t>& bad : {std::vector<std::uint32_t>{3}, {1, 1}, {2, 0}, {0, 2, 3}})
  {
    state.moved = bad;
    EXPECT_THAT(Refusal(state), HasSubstr("moved: ")) << testing::PrintToString(bad);
  }
}

TEST(LimitsOfFaults, TheyAreOfControllersThatMayFailAndAscend)
{
  Experiment experiment = ThreeRobots();
  for (const auto& [id, on_failure] : {std::pair("steady", OnFailure::kAbort), {"frail", OnFailure::kRestart}})
  {
    ControllerConfiguration& controller = experiment.controllers.emplace_back();
    controller.id = id;
    controller.on_failure = on_failure;
  }
  experiment.entities[0].controller = experiment.entities[2].controller = "frail";
  experiment.entities[1].controller = "steady";
  const CSwarmanoidSpace space(experiment);
  const TickLimits limits(space, MakeAssignment(experiment, 1), false);
  const auto refusal = [&](const ControllerFaults& faults)
  {
    ControlCommands commands;
    commands.faults = faults;
    return test::MessageOf<BadMessage>([&] { limits.Check({1, 1, 0, false}, commands); });
  };
  const FaultKind died = FaultKind::kDied;
  for (const ControllerFaults& good :
       {ControllerFaults{}, {{0}, {died}}, {{2}, {FaultKind::kThrew}}, {{0, 2}, {died, FaultKind::kTooSlow}}})
    EXPECT_EQ(refusal(good), "");
  for (const ControllerFaults& bad :
       {ControllerFaults{{1}, {died}}, {{3}, {died}}, {{2, 0}, {died, died}}, {{0, 0}, {died, died}}})
    EXPECT_THAT(refusal(bad), HasSubstr("faults.robots: "));
  for (const ControllerFaults& bad :
       {ControllerFaults{{0}, {}}, {{}, {died}}, {{0}, {FaultKind(0)}}, {{0}, {FaultKind(4)}}})
    EXPECT_THAT(refusal(bad), HasSubstr("faults.kinds: "));
  ControllerFaults with_text;
  Add(with_text, 0, FaultKind::kThrew, "no map at 3 m, says «plan»");
  EXPECT_EQ(refusal(with_text), "");
  with_text.texts[3] = '\x1b';
  EXPECT_THAT(refusal(with_text), HasSubstr("faults.texts: "));
  const Experiment without = ThreeRobots();
  const CSwarmanoidSpace others(without);
  const std::size_t bytes_of_two = 2 * (sizeof(std::uint32_t) + sizeof(FaultKind) + 1) + kMostFaultText;
  EXPECT_EQ(limits.CommandBytes(), TickLimits(others, MakeAssignment(without, 1), false).CommandBytes() + bytes_of_two);
}

TEST(TextsOfFaults, AreOneLineForEachRobotAndAreCutTogether)
{
  ControllerFaults faults;
  Add(faults, 3, FaultKind::kThrew, "first");
  Add(faults, 5, FaultKind::kDied, "");
  Add(faults, 8, FaultKind::kThrew, std::string(kMostFaultText - 5, 'x'));
  Add(faults, 9, FaultKind::kThrew, "y");
  EXPECT_EQ(TextsOf(faults), (std::vector<std::string>{"first", "", std::string(kMostFaultText - 5, 'x'), ""}));
  EXPECT_EQ(faults.texts.size(), kMostFaultText + 4);
  ControllerFaults without = faults;
  without.texts.clear();
  EXPECT_EQ(TextsOf(without), std::vector<std::string>(4));
  EXPECT_EQ(without, faults);
}

// Experiment functions alone change cells of floor fields between the steps.
TEST(LimitsOfFloorFields, CellsMayBeSetIfThereIsOneAndFunctionsAre)
{
  for (const std::size_t columns : {0U, 1U, 3U})
    for (const bool has_functions : {false, true})
    {
      Experiment experiment = ThreeRobots();
      if (columns > 0)
      {
        FloorFieldConfiguration& field = experiment.floor_fields.emplace_back();
        field.id = "trail";
        field.cell_m = 1;
        field.columns = columns;
        field.rows = 1;
      }
      if (has_functions) experiment.functions.emplace_back();
      const CSwarmanoidSpace space(experiment);
      const TickLimits limits(space, MakeAssignment(experiment, 1), false);
      SpaceState state;
      state.poses.resize(7 * 3);
      state.fields.runs = {0, 1};
      state.fields.values = {0.5};
      const std::string refusal = test::MessageOf<BadMessage>([&] { limits.Check({1, 1, 0, false}, state); });
      EXPECT_EQ(refusal.empty(), columns > 0 && has_functions) << columns << " " << has_functions << refusal;
    }
}

}  // namespace
}  // namespace swarmanoid
