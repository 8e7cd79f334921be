// A run whose space server has died at any point is resumed.
#include "space_server/cluster/restart_point.h"

#include <unistd.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "common/checkpoint/host_state.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

Experiment FourRobots()
{
  Experiment experiment = test::RobotsOf("", {"fb_0", "fb_1", "fb_2", "fb_3"});
  experiment.effective_xml = "<ahss-config><framework><maxclock>100</maxclock></framework></ahss-config>";
  return experiment;
}

SavedPart HostPart(std::size_t host, std::map<std::uint32_t, std::string> robots)
{
  ByteWriter bytes;
  WriteFields(bytes, HostState{{}, std::move(robots)});
  return {HostName(host), bytes.Bytes()};
}

class ContinuationTest : public testing::Test
{
protected:
  ContinuationTest()
  {
    std::filesystem::create_directory(folder_ / "journal");
    settings_.output_folder = folder_.Path();
  }
  const test::TemporaryFolder folder_;
  const Experiment experiment_ = FourRobots();
  RunSettings settings_;
};

// The server wrote the new hosts of the robots, and died before it wrote their saved states.
TEST_F(ContinuationTest, WhatNewHostsRememberIsWrittenIfTheServerDiedBefore)
{
  const HostTable first{2, {0, 0, 1, 1}}, second{2, {0, 1, 0, 1}};
  const std::string file = JournalFile(settings_.output_folder);
  {
    JournalWriter journal(file, ContentOf(JournalStart{OriginOf(experiment_), first, 0}));
    for (std::uint64_t tick = 0; tick < 12; ++tick)
    {
      SpaceState state;
      state.tick = tick;
      if (tick == 10)
      {
        journal.Add(SpaceSnapshot{.tick = tick, .poses = {}, .attributes = {}});
        journal.Add(tick, {kServerPart, {'s'}});
        journal.Add(tick, {EngineName(experiment_, 0), {'e'}});
        journal.Add(tick, HostPart(0, {{0, "a"}, {1, "b"}}));
        journal.Add(tick, HostPart(1, {{2, "c"}, {3, "d"}}));
      }
      journal.AddTick(state, false, {}, {});
    }
  }
  {
    const RestartPoint died(settings_, experiment_);
    ASSERT_EQ(died.Tick(), 10U);
    JournalWriter journal(*died.Journal(), died.Tick());
    journal.BeginHosts(second, died.Tick());
  }
  for (int again = 0; again < 2; ++again)
  {
    const RestartPoint restart_point(settings_, experiment_);
    ASSERT_EQ(restart_point.Tick(), 10U);
    ASSERT_EQ(restart_point.Journal()->Hosts(), second);
    JournalWriter journal(*restart_point.Journal(), restart_point.Tick());
    const std::size_t before = journal.Places().size();
    restart_point.ShareOut(journal, experiment_, second);
    journal.Flush();
    const auto checkpoint = JournalReader(file).CheckpointAt(10, PartsOf(experiment_, 2), 1);
    ASSERT_TRUE(checkpoint);
    std::map<std::uint32_t, std::string> robots;
    checkpoint->LoadPart(HostName(1), [&](ByteReader& bytes) { robots = ReadFields<HostState>(bytes).robots; });
    EXPECT_EQ(robots, (std::map<std::uint32_t, std::string>{{1, "b"}, {3, "d"}}));
    // A second time there is nothing to write.
    EXPECT_EQ(journal.Places().size() - before, again == 0 ? 5U : 0U);
  }
}

}  // namespace
}  // namespace swarmanoid
