// A process that hears the states of a space has the same floor fields as the space server, also after it took a
// snapshot, and so has a reader of the journal.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "common/journal/tick_records.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "simulation/register_all.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

// Two robots with the actuator, and one without it between them.
std::unique_ptr<Experiment> ThreeRobots()
{
  RegisterBuiltins();
  LoadOptions options;
  options.check_files = false;
  return test::ExperimentText{
      .controllers =
          "<nothing id='c'><actuators><floor_field implementation='generic_floor_field' point='0.1, 0'/>"
          "</actuators></nothing>",
      .size = "4,4,1",
      .arena =
          "<floor_field id='trail' evaporation='0.5' diffusion='1e-3' period='3'/><floor_field id='food' cell='0.3'/>"
          "<footbot id='a' position='1,1,0' controller='c'/><footbot id='n' position='2,2,0'/>"
          "<footbot id='b' position='3,2,0' orientation='0,0,90' controller='c'/>"}
      .Load(".", "test.xml", options);
}

// Does what the space server does in a tick: robots change their rates and places, and functions change three cells.
SpaceState NextTick(CSwarmanoidSpace& space)
{
  const auto tick = static_cast<double>(space.GetTick());
  const std::uint32_t a = space.RateSlotOf(0), b = space.RateSlotOf(2);
  space.AdvanceFields();
  SpaceState state;
  if (space.GetTick() % 4 == 0)
  {
    state.attributes.Add(a, tick);
    state.attributes.Add(a + 1, 1);
  }
  if (space.GetTick() % 5 == 0) state.attributes.Add(b, 10 - tick);
  space.SetAttributes(state.attributes);
  space.SetPose(0, {{1 + 0.03 * tick, 1, 0}, Quaternion::Identity()});
  space.SetPose(2, {{3, 2 - 0.02 * tick, 0}, Quaternion::Identity()});
  space.SetTick(space.GetTick() + 1);
  state.tick = space.GetTick();
  if (state.tick % 7 == 3)
    for (const std::uint32_t cell : {5U, 6U, 6403U})
    {
      space.Fields().Set(cell, static_cast<float>(tick));
      AddCell(state.fields, cell, space.Fields().ValueOf(cell));
    }
  space.WritePoses(state.poses);
  return state;
}

SpaceSnapshot SnapshotOf(CSwarmanoidSpace& space)
{
  SpaceSnapshot snapshot;
  snapshot.tick = space.GetTick();
  space.WritePoses(snapshot.poses);
  snapshot.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
  space.Fields().WriteCells(snapshot.fields);
  return snapshot;
}

TEST(FloorFieldReplicas, HaveTheHashesOfTheServer)
{
  const auto experiment = ThreeRobots();
  ASSERT_TRUE(experiment);
  CSwarmanoidSpace server(*experiment), replica(*experiment), late(*experiment), stopped(*experiment);
  stopped.Fields().Stop();
  EXPECT_EQ(EntityOfSlot(server, server.RateSlotOf(2) + 1), 2U);
  TickRows rows;
  std::vector<std::uint64_t> hashes;
  for (int tick = 0; tick < 40; ++tick)
  {
    if (tick == 20)
    {
      const SpaceSnapshot snapshot = ReadSnapshot(ContentOf(SnapshotOf(server)));
      EXPECT_EQ(snapshot.tick, 20U);
      EXPECT_FALSE(snapshot.fields.values.empty());
      CheckSnapshot(stopped, snapshot);
      late.Fields().Set(9, 3);
      late.Apply(snapshot);
      EXPECT_EQ(late.Hash(), server.Hash());
      SpaceState again;
      again.tick = snapshot.tick;
      again.poses = snapshot.poses;
      late.Apply(again);
      EXPECT_EQ(late.Hash(), server.Hash()) << "the state of the tick of the snapshot makes no step";
    }
    const SpaceState state = NextTick(server);
    replica.Apply(state);
    stopped.Apply(state);
    EXPECT_EQ(replica.Hash(), server.Hash()) << tick;
    if (tick >= 20)
    {
      late.Apply(state);
      EXPECT_EQ(late.Hash(), server.Hash()) << tick;
    }
    ASSERT_TRUE(rows.Add(state, false, {}, {}));
    hashes.push_back(server.Hash());
  }
  EXPECT_GT(server.Fields().Field("trail").Total(), 0);
  EXPECT_THROW(static_cast<const CSwarmanoidSpace&>(stopped).Fields(), std::logic_error);

  ReusedMemory room;
  TickRecordReader reader(rows.Content(room), 40);
  TickRecord record;
  CSwarmanoidSpace played(*experiment);
  for (const std::uint64_t hash : hashes)
  {
    ASSERT_TRUE(reader.Next(record));
    played.Apply(record.state);
    EXPECT_EQ(played.Hash(), hash) << record.state.tick;
  }
}

TEST(FloorFieldReplicas, RefuseWrongCellsAndRates)
{
  const auto experiment = ThreeRobots();
  ASSERT_TRUE(experiment);
  CSwarmanoidSpace space(*experiment);
  SpaceSnapshot wrong = SnapshotOf(space);
  CheckSnapshot(space, wrong);
  AddCell(wrong.fields, 999'999, 1);
  EXPECT_THROW(CheckSnapshot(space, wrong), StateError);
  try
  {
    CheckAttribute(space, space.RateSlotOf(2) + 1, 1e10);
    ADD_FAILURE() << "a rate of 1e10";
  }
  catch (const StateError& error)
  {
    EXPECT_STREQ(
        error.what(),
        "the rate of deposits on the floor field 'food' of the footbot 'b' is 10000000000: it must be finite and "
        "at most 1e9 from 0");
  }
}

}  // namespace
}  // namespace swarmanoid
