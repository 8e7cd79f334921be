// Looking back: whichever tick of a journal is asked for next, the space is as it was there, bit by bit.
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "common/journal/journal_follower.h"
#include "common/journal/journal_reader.h"
#include "common/journal/recorded_states.h"
#include "common/space/space.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

Experiment TwoRobots()
{
  Experiment experiment;
  experiment.name = "two";
  experiment.arena_size = {4, 4, 2};
  for (const char* id : {"fb_0", "fb_1"}) experiment.entities.push_back(test::Entity(EntityKind::kFootbot, id));
  return experiment;
}

class RecordedStatesTest : public testing::Test
{
protected:
  std::string Path() const { return (folder_ / "0").string(); }
  static JournalStart Start() { return {{7, {}}, {}, 0}; }

  // Robots jump about, and an LED changes now and then. Remembers the hash of each tick.
  void Run(JournalWriter& journal, std::uint64_t ticks)
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> real(0, 4);
    const std::uint32_t led = space_.GetEntity(0).SlotOf("led", 0);
    SpaceSnapshot snapshot;
    for (SpaceState state; state.tick < ticks; ++state.tick)
    {
      state.poses.assign(14, 0.0);
      for (std::size_t k = 0; k < 4; ++k) state.poses[k] = real(random);
      state.poses[12] = state.poses[13] = 1;
      state.attributes.Clear();
      if (random() % 20 == 0)
        state.attributes.Add(led + static_cast<std::uint32_t>(random() % 12), static_cast<double>(random() % 0xffffff));
      space_.Apply(state);
      hashes_.push_back(space_.Hash());
      if (state.tick > 0 && state.tick % 100 == 0)
      {
        snapshot.tick = state.tick;
        space_.WritePoses(snapshot.poses);
        snapshot.attributes.assign(space_.Attributes().Values().begin(), space_.Attributes().Values().end());
        journal.Add(snapshot);
        journal.Add(state.tick, {kServerPart, {'s'}});
      }
      journal.AddTick(state, false, {}, {});
      if (random() % 30 == 0) journal.Flush();
    }
    journal.Flush();
  }

  void ExpectSameEverywhere(RecordedStates& states, std::uint64_t first, std::uint64_t end)
  {
    std::mt19937 random(9);
    for (int k = 0; k < 300; ++k)
    {
      const std::uint64_t tick = first + random() % (end - first);
      ASSERT_TRUE(states.Seek(tick)) << tick;
      EXPECT_EQ(states.Space().GetTick(), tick);
      EXPECT_EQ(states.Space().Hash(), hashes_[tick]) << tick;
      EXPECT_EQ(states.Record().state.tick, tick);
      if (tick + 1 == end) continue;
      ASSERT_TRUE(states.Next());
      EXPECT_EQ(states.Space().Hash(), hashes_[tick + 1]) << "after " << tick;
    }
    EXPECT_FALSE(states.Seek(end));
    EXPECT_FALSE(states.Seek(first - 1)) << "of the first one, some tick that never was";
  }

  const test::TemporaryFolder folder_;
  const Experiment experiment_ = TwoRobots();
  CSwarmanoidSpace space_{experiment_};
  std::vector<std::uint64_t> hashes_;
};

TEST_F(RecordedStatesTest, AnyTickAfterAnyOther)
{
  JournalWriter journal(Path(), ContentOf(Start()));
  Run(journal, 1000);
  const JournalReader reader(Path());
  RecordedStates states(experiment_, reader, reader.Start());
  ASSERT_TRUE(states.Next());
  EXPECT_EQ(states.Space().Hash(), hashes_[0]);
  ExpectSameEverywhere(states, 0, 1000);
}

TEST_F(RecordedStatesTest, WhatABudgetHasLeft)
{
  JournalWriter journal(Path(), ContentOf(Start()), false, {16U << 10U, {kServerPart}});
  JournalFollower follower(Path());
  Run(journal, 3000);
  follower.Refresh();
  ASSERT_GT(follower.FirstTick(), 0U);
  RecordedStates states(experiment_, follower, follower.Start());
  ExpectSameEverywhere(states, follower.FirstTick(), 3000);
}

// Attributes that changed in the lost ticks are right again from the next saved state on.
TEST_F(RecordedStatesTest, AfterDamageTheNextSavedStateIsRight)
{
  {
    JournalWriter journal(Path(), ContentOf(Start()));
    Run(journal, 1000);
  }
  const std::vector<JournalPlace> places = JournalReader(Path()).Places();
  const auto hit = std::find_if(places.begin(), places.end(),
                                [](const JournalPlace& place)
                                { return place.kind == JournalBlockKind::kTicks && place.first_tick > 240; });
  {
    std::fstream file(Path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(hit->offset + 100));
    file.put('x').put('y');
  }
  const std::uint64_t saved = (hit->first_tick + hit->ticks + 99) / 100 * 100;
  JournalReader reader(Path());
  JournalFollower follower(Path());
  follower.Refresh();
  for (const JournalBlocks* blocks :
       {static_cast<const JournalBlocks*>(&reader), static_cast<const JournalBlocks*>(&follower)})
  {
    RecordedStates states(experiment_, *blocks, reader.Start());
    std::vector<std::uint64_t> read, expected;
    while (states.Next())
    {
      read.push_back(states.Space().GetTick());
      ASSERT_EQ(states.Space().Hash(), hashes_[read.back()]) << read.back();
    }
    for (std::uint64_t tick = 0; tick < 1000; ++tick)
    {
      const bool is_lost = tick >= hit->first_tick && tick < saved;
      if (!is_lost) expected.push_back(tick);
      EXPECT_EQ(states.Seek(tick), !is_lost) << tick;
      if (!is_lost)
      {
        EXPECT_EQ(states.Space().Hash(), hashes_[tick]);
      }
    }
    EXPECT_EQ(read, expected);
    ASSERT_TRUE(states.SeekFrom(hit->first_tick));
    EXPECT_EQ(states.Space().GetTick(), saved);
  }
}

}  // namespace
}  // namespace swarmanoid
