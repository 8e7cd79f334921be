// Journals with a size limit keep the newest ticks whole and readable, and drop nothing that a restart needs.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include <gmock/gmock.h>

#include "common/journal/journal_follower.h"
#include "common/journal/journal_reader.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint64_t kBudget = 64U << 10U;
constexpr std::uint64_t kPeriod = 50;  // ticks between two saved states
const std::vector<std::string> kParts{kServerPart, "engine 'ground'"};

// Returns numbers that cannot be compressed. They are equal for a tick in each run.
SpaceState NoisyState(std::uint64_t tick)
{
  std::mt19937_64 random(tick);
  std::uniform_real_distribution<double> real(-10, 10);
  SpaceState state;
  state.tick = tick;
  for (int k = 0; k < 14; ++k) state.poses.push_back(real(random));
  return state;
}

class JournalSegmentsTest : public testing::Test
{
protected:
  std::string Path() const { return (folder_ / "0").string(); }
  static std::vector<char> StartOfRun() { return ContentOf(JournalStart{{7, {}}, HostTable{1, {0, 0, 0, 0}}, 0}); }

  static void AddSomeTicks(JournalWriter& journal, std::uint64_t from, std::uint64_t until,
                           const std::vector<std::string>& saved = kParts, bool waits = true)
  {
    for (std::uint64_t tick = from; tick < until; ++tick)
    {
      const SpaceState state = NoisyState(tick);
      if (tick > 0 && tick % kPeriod == 0)
      {
        SpaceSnapshot snapshot;
        snapshot.tick = tick;
        snapshot.poses = state.poses;
        journal.Add(snapshot);
        for (const std::string& part : saved) journal.Add(tick, {part, {'s'}});
      }
      journal.AddTick(state, false, {}, {});
      if (waits && tick % kPeriod == kPeriod - 1) journal.Flush();
    }
  }

  // All ticks from the first to the last one, with the bits that were written.
  static void ExpectWhole(const JournalReader& journal, std::uint64_t end)
  {
    std::uint64_t next = journal.FirstTick();
    journal.ForEachTick(
        [&](const TickRecord& record)
        {
          if (record.state.tick < journal.FirstTick()) return;
          EXPECT_EQ(record.state.tick, next++);
          EXPECT_EQ(record.state.poses, NoisyState(record.state.tick).poses);
        });
    EXPECT_EQ(next, end);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(JournalSegmentsTest, ABudgetKeepsTheNewestAndASavedStateBeforeIt)
{
  JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
  std::uint64_t all = 0;
  for (std::uint64_t tick = 0; tick < 6000; tick += 10 * kPeriod)
  {
    AddSomeTicks(journal, tick, tick + 10 * kPeriod);
    // The segment that is written, and one that may still be needed, come on top.
    EXPECT_LT(journal.Bytes(), kBudget + kBudget / 2);
    const JournalReader read(Path());
    EXPECT_EQ(read.Bytes(), journal.Bytes());
    ExpectWhole(read, tick + 10 * kPeriod);
    EXPECT_EQ(read.RestartTick([](std::uint64_t) { return true; }), tick + 9 * kPeriod);
    EXPECT_TRUE(read.CheckpointAt(tick + 9 * kPeriod, kParts));
    all = read.FirstTick();
  }
  EXPECT_GT(all, 4000U) << "the oldest is deleted";
  EXPECT_FALSE(fs::exists(Path()));
  EXPECT_FALSE(journal.TakeExcess());
}

// A disk can be slower than the run: saved states wait in the queue before earlier ones are written.
TEST_F(JournalSegmentsTest, ABudgetIsUsedUpEvenIfManySavedStatesWaitForTheDisk)
{
  JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
  AddSomeTicks(journal, 0, 6000, kParts, false);
  journal.Flush();
  const JournalReader read(Path());
  ExpectWhole(read, 6000);
  EXPECT_GT(read.Bytes(), kBudget / 2);
  EXPECT_LT(read.Bytes(), kBudget + kBudget / 2);
}

// A run that resumes with other controller hosts begins a segment. Its state is older than the tick at which it
// resumes.
TEST_F(JournalSegmentsTest, OtherControllerHostsBeginASegment)
{
  {
    JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
    AddSomeTicks(journal, 0, 130);
  }
  const JournalReader before(Path());
  EXPECT_EQ(before.Hosts(), (HostTable{1, {0, 0, 0, 0}}));
  const HostTable three{3, {2, 0, 1, 0}};
  JournalWriter journal(before, 120, false, {kBudget, kParts});
  journal.BeginHosts(three, 120);
  SpaceSnapshot snapshot;
  snapshot.tick = 100;
  journal.Add(snapshot);
  for (const std::string& part : kParts) journal.Add(100, {part, {'t'}});
  AddSomeTicks(journal, 120, 150);
  journal.Flush();
  const JournalReader after(Path());
  EXPECT_EQ(after.Hosts(), three);
  EXPECT_EQ(after.HostsAt(119), before.Hosts());
  EXPECT_EQ(after.HostsAt(120), three);
  EXPECT_THROW(after.HostsAt(150), std::runtime_error);
  EXPECT_EQ(after.Start().hosts, before.Hosts());
  EXPECT_EQ(journal.Start().hosts, three);
  ExpectWhole(after, 150);
  EXPECT_EQ(after.CheckpointAt(100, kParts, 0)->StateOf(kServerPart)[0], 's');
  EXPECT_EQ(after.CheckpointAt(100, kParts, 1)->StateOf(kServerPart)[0], 't');
  for (const JournalPlace& place : after.Places())
  {
    if (place.kind != JournalBlockKind::kTicks) continue;
    EXPECT_EQ(place.table, place.first_tick < 120 ? 0U : 1U);
    EXPECT_EQ(journal.Table(place.table), place.first_tick < 120 ? before.Hosts() : three);
  }
  AddSomeTicks(journal, 150, 6000);
  journal.Flush();
  const JournalReader much_later(Path());
  EXPECT_GT(much_later.FirstTick(), 120U);
  ExpectWhole(much_later, 6000);
  EXPECT_EQ(FirstTickOf(after.Start(),
                        [&]
                        {
                          std::vector<JournalPlace> rest = after.Places();
                          std::erase_if(rest, [](const JournalPlace& place) { return place.table == 0; });
                          rest.push_back({JournalBlockKind::kSnapshot, 150, 0, {}, 0, 0, 2, 1});
                          return rest;
                        }()),
            150U);
}

// The number of hosts is the same, but they have other robots.
TEST_F(JournalSegmentsTest, TheSameHostsWithOtherRobotsBeginASegment)
{
  const HostTable first{2, {0, 0, 1, 1}}, second{2, {0, 1, 0, 1}};
  const std::vector<char> start = ContentOf(JournalStart{{7, {}}, first, 0});
  {
    JournalWriter journal(Path(), start, false, {0, kParts});
    AddSomeTicks(journal, 0, 130);
  }
  const JournalReader before(Path());
  JournalWriter journal(before, 100, false, {0, kParts});
  journal.BeginHosts(second, 100);
  journal.Add(SpaceSnapshot{.tick = 100, .poses = {}, .attributes = {}});
  for (const std::string& part : kParts) journal.Add(100, {part, {'t'}});
  journal.Flush();
  const JournalReader after(Path());
  EXPECT_EQ(after.Tables(), (std::vector<HostTable>{first, second}));
  EXPECT_EQ(after.Hosts(), second);
  EXPECT_EQ(after.CheckpointAt(100, kParts, 0)->StateOf(kServerPart)[0], 's');
  EXPECT_EQ(after.CheckpointAt(100, kParts, 1)->StateOf(kServerPart)[0], 't');
  // A later writer has the second hosts as well.
  JournalWriter later(after, 100, false, {0, kParts});
  later.AddTick(NoisyState(100), false, {}, {});
  later.Flush();
  EXPECT_EQ(later.Table(later.Places().back().table), second);
}

// If a server dies right after it has written where the run continues, no earlier tick is lost.
TEST_F(JournalSegmentsTest, TheTicksBeforeAreWholeAsSoonAsTheRunGoesOn)
{
  {
    JournalWriter journal(Path(), StartOfRun(), false, {0, kParts});
    AddSomeTicks(journal, 0, 130);
  }
  {
    const JournalReader before(Path());
    const JournalWriter journal(before, 120, false, {0, kParts});
  }
  const std::vector<JournalPlace> places = JournalReader(Path()).Places();
  const auto mark = std::ranges::find(places, JournalBlockKind::kGoOn, &JournalPlace::kind);
  ASSERT_NE(mark, places.end());
  fs::resize_file(Path(), mark->offset + mark->bytes);
  const JournalReader cut(Path());
  ExpectWhole(cut, 121);
  EXPECT_EQ(cut.RecordOf(120)->state.tick, 120U);
  EXPECT_FALSE(cut.RecordOf(121));
}

// A run may be resumed several times, each time at an earlier tick and with other robots at its hosts.
TEST_F(JournalSegmentsTest, TicksKeepTheHostsThatSteppedThem)
{
  const HostTable first{2, {0, 0, 1, 1}}, second{2, {0, 1, 0, 1}}, third{2, {1, 0, 0, 1}};
  {
    JournalWriter journal(Path(), ContentOf(JournalStart{{7, {}}, first, 0}), false, {0, kParts});
    AddSomeTicks(journal, 0, 130);
  }
  const auto go_on = [&](std::uint64_t tick, const HostTable& hosts, std::uint64_t end)
  {
    const JournalReader before(Path());
    JournalWriter journal(before, tick, false, {0, kParts});
    journal.BeginHosts(hosts, tick);
    AddSomeTicks(journal, tick, end);
  };
  go_on(120, second, 140);
  go_on(70, third, 160);
  const JournalReader after(Path());
  ExpectWhole(after, 160);
  for (const std::uint64_t tick : {0U, 63U, 64U, 69U}) EXPECT_EQ(after.HostsAt(tick), first) << tick;
  for (const std::uint64_t tick : {70U, 120U, 159U}) EXPECT_EQ(after.HostsAt(tick), third) << tick;
  JournalFollower follower(Path());
  follower.Refresh();
  EXPECT_EQ(EndTickOf(after.Start(), follower.Places()), 160U);
}

TEST_F(JournalSegmentsTest, ATableOfHostsThatThereAreNotIsRefused)
{
  for (const HostTable& table :
       {HostTable{0, {}}, HostTable{2, {0}}, HostTable{2, {0, 2}}, HostTable{4000000000, {0, 1}}})
    EXPECT_THROW(ReadStart(ContentOf(JournalStart{{7, {}}, table, 0})), std::runtime_error);
}

// Ticks that were added before an earlier tick's state arrived are in the segment before that state.
TEST_F(JournalSegmentsTest, NothingIsDroppedThatFollowsAStateThatCameLate)
{
  constexpr std::uint64_t kSmallBudget = 1024;  // deletes a segment as soon as it is not needed
  JournalWriter journal(Path(), StartOfRun(), false, {kSmallBudget, kParts});
  for (std::uint64_t tick = 0; tick < 1000; ++tick)
  {
    journal.AddTick(NoisyState(tick), false, {}, {});
    if (tick % kPeriod == kPeriod - 1) journal.Flush();
    if (tick < kPeriod || tick % kPeriod != kPeriod / 2) continue;
    SpaceSnapshot snapshot;
    snapshot.tick = tick - kPeriod / 2;
    snapshot.poses = NoisyState(snapshot.tick).poses;
    journal.Add(snapshot);
    for (const std::string& part : kParts) journal.Add(snapshot.tick, {part, {'s'}});
    journal.Flush();
    const JournalReader read(Path());
    ASSERT_TRUE(read.CheckpointAt(snapshot.tick, kParts));
    std::uint64_t next = snapshot.tick;
    read.ForEachTick([&](const TickRecord& record) { next += record.state.tick == next ? 1 : 0; });
    ASSERT_EQ(next, tick + 1) << "of the state of tick " << snapshot.tick;
  }
  EXPECT_FALSE(fs::exists(Path())) << "the oldest is deleted";
}

// A process may save its part of a state when the next state, and with it a segment, has begun.
TEST_F(JournalSegmentsTest, NoPartOfAStateIsDroppedThatLaterPartsMakeWhole)
{
  for (const bool snapshot_first : {true, false})
  {
    JournalWriter journal(Path(), StartOfRun(), false, {1024, kParts});
    for (std::uint64_t tick = 0; tick < 1000; ++tick)
    {
      journal.AddTick(NoisyState(tick), false, {}, {});
      const std::uint64_t phase = tick % kPeriod;
      const bool is_first = phase == 0;
      if (tick < 2 * kPeriod || (!is_first && phase != kPeriod / 2)) continue;
      const std::uint64_t saved = is_first ? tick : tick - phase - kPeriod;
      if (is_first == snapshot_first)
      {
        SpaceSnapshot snapshot;
        snapshot.tick = saved;
        snapshot.poses = NoisyState(saved).poses;
        journal.Add(snapshot);
      }
      else
      {
        for (const std::string& part : kParts) journal.Add(saved, {part, {'s'}});
      }
      journal.Flush();
      ASSERT_TRUE(is_first || saved < 2 * kPeriod || JournalReader(Path()).CheckpointAt(saved, kParts)) << saved;
    }
    EXPECT_FALSE(fs::exists(Path())) << "the oldest is deleted";
  }
}

TEST_F(JournalSegmentsTest, WithoutABudgetEverythingIsInOneFile)
{
  {
    JournalWriter journal(Path(), StartOfRun());
    AddSomeTicks(journal, 0, 2000);
  }
  EXPECT_EQ(SegmentsOf(Path()), std::vector<std::uint32_t>{0});
  ExpectWhole(JournalReader(Path()), 2000);
}

TEST_F(JournalSegmentsTest, AllIsKeptIfAProcessSavesNoState)
{
  JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
  AddSomeTicks(journal, 0, 3000, {kServerPart});
  ExpectWhole(JournalReader(Path()), 3000);
  EXPECT_EQ(JournalReader(Path()).FirstTick(), 0U);
  const auto excess = journal.TakeExcess();
  ASSERT_TRUE(excess);
  EXPECT_THAT(*excess, HasSubstr("engine 'ground' could not be replaced"));
  EXPECT_FALSE(journal.TakeExcess()) << "it is told once";
}

TEST_F(JournalSegmentsTest, CutAnywhereInItsNewestSegmentItGoesOn)
{
  {
    JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
    AddSomeTicks(journal, 0, 2000);
  }
  const std::uint32_t newest = SegmentsOf(Path()).back();
  const fs::path whole = folder_ / "whole";
  fs::rename(SegmentFile(Path(), newest), whole);
  for (std::uint64_t length = 0; length < fs::file_size(whole); length += 37)
  {
    fs::copy_file(whole, SegmentFile(Path(), newest));
    fs::resize_file(SegmentFile(Path(), newest), length);
    const std::uint64_t end = EndTickOf(JournalReader(Path()).Start(), JournalReader(Path()).Places());
    ExpectWhole(JournalReader(Path()), end);
    if (length % 5 == 0)
    {
      const fs::path kept = folder_ / "kept";
      fs::copy(folder_, kept);
      const auto tick = JournalReader((kept / "0").string()).RestartTick([](std::uint64_t) { return true; });
      ASSERT_TRUE(tick);
      {
        const JournalReader before((kept / "0").string());
        JournalWriter journal(before, *tick, false, {kBudget, kParts});
        AddSomeTicks(journal, *tick, *tick + 1000);
      }
      ExpectWhole(JournalReader((kept / "0").string()), *tick + 1000);
      fs::remove_all(kept);
    }
    fs::remove(SegmentFile(Path(), newest));
  }
}

TEST_F(JournalSegmentsTest, AMissingSegmentIsNamedAndThoseBeforeAndAfterItAreRead)
{
  {
    JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
    AddSomeTicks(journal, 0, 3000);
  }
  const std::vector<std::uint32_t> segments = SegmentsOf(Path());
  ASSERT_GT(segments.size(), 4U);
  const std::uint32_t missing = segments[2];
  const JournalReader whole(Path());
  fs::remove(SegmentFile(Path(), missing));
  const JournalReader rest(Path());
  EXPECT_EQ(rest.Damages(), (std::vector<JournalDamage>{{SegmentFile(Path(), missing), 0, 0}}));
  std::size_t expected = 0;
  for (const JournalPlace& place : whole.Places()) expected += place.segment == missing ? 0 : 1;
  EXPECT_EQ(rest.Places().size(), expected);
  EXPECT_EQ(ReadableTicks(rest.Start(), rest.Places()).size(), 2U);
  JournalFollower follower(Path());
  follower.Refresh();
  EXPECT_EQ(follower.Places().size(), expected);
}

// A run resumes before the damage, and computes the lost ticks again.
TEST_F(JournalSegmentsTest, ARunGoesOnWithADamagedJournal)
{
  for (const std::size_t hit : {std::size_t{0}, std::size_t{1}, std::size_t{40}})
  {
    SCOPED_TRACE(hit);
    {
      JournalWriter journal(Path(), StartOfRun(), false, {8 * kBudget, kParts});
      AddSomeTicks(journal, 0, 2000);
    }
    const std::vector<std::uint32_t> segments = SegmentsOf(Path());
    ASSERT_GT(segments.size(), 2U);
    const std::vector<JournalPlace> places = JournalReader(Path()).Places();
    const auto first = std::find_if(places.begin(), places.end(),
                                    [&](const JournalPlace& place) { return place.segment == segments[1]; });
    {
      std::fstream file(SegmentFile(Path(), segments[1]), std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(static_cast<std::streamoff>((first + static_cast<std::ptrdiff_t>(hit))->offset + 12));
      file.put('\x7e');
    }
    const JournalReader before(Path());
    ASSERT_EQ(before.Damages().size(), 1U);
    const auto tick = before.RestartTick([](std::uint64_t) { return true; });
    ASSERT_TRUE(tick);
    {
      JournalWriter journal(before, *tick, false, {8 * kBudget, kParts});
      AddSomeTicks(journal, *tick, 2500);
    }
    const JournalReader after(Path());
    ExpectWhole(after, 2500);
    EXPECT_EQ(ReadableTicks(after.Start(), after.Places()), (std::vector<TickRange>{{after.FirstTick(), 2500}}));
    for (const std::uint32_t segment : SegmentsOf(Path())) fs::remove(SegmentFile(Path(), segment));
  }
}

TEST_F(JournalSegmentsTest, ANewJournalHasNoSegmentsOfAnEarlierOne)
{
  {
    JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
    AddSomeTicks(journal, 0, 3000);
  }
  ASSERT_GT(SegmentsOf(Path()).size(), 1U);
  {
    JournalWriter journal(Path(), StartOfRun());
    AddSomeTicks(journal, 0, 100);
  }
  ExpectWhole(JournalReader(Path()), 100);
}

TEST_F(JournalSegmentsTest, WhoeverFollowsItSeesWhatAReaderSees)
{
  JournalFollower follower(Path());
  EXPECT_NO_THROW(follower.Refresh()) << "nothing is there yet";
  EXPECT_FALSE(follower.IsBegun());
  const auto expect_same = [&]
  {
    follower.Refresh();
    const JournalReader reader(Path());
    EXPECT_EQ(follower.FirstTick(), reader.FirstTick());
    ASSERT_EQ(follower.Places().size(), reader.Places().size());
    for (std::size_t k = 0; k < reader.Places().size(); ++k)
    {
      const JournalPlace& place = follower.Places()[k];
      EXPECT_EQ(place.kind, reader.Places()[k].kind);
      EXPECT_EQ(place.first_tick, reader.Places()[k].first_tick);
      EXPECT_EQ(follower.Content(place), reader.Content(reader.Places()[k]));
    }
  };
  std::uint64_t tick = 0;
  {
    JournalWriter journal(Path(), StartOfRun(), false, {kBudget, kParts});
    for (; tick < 3000; tick += 4 * kPeriod)
    {
      AddSomeTicks(journal, tick, tick + 4 * kPeriod);
      expect_same();
    }
  }
  {
    const JournalReader before(Path());
    const auto back = before.RestartTick([&](std::uint64_t usable) { return usable + 2 * kPeriod < tick; });
    ASSERT_LT(*back, tick - 2 * kPeriod) << "some ticks are done again";
    JournalWriter journal(before, *back, false, {kBudget, kParts});
    AddSomeTicks(journal, *back, *back + kPeriod);  // so few that none of before is deleted
    journal.Flush();
    expect_same();
  }
}

}  // namespace
}  // namespace swarmanoid
