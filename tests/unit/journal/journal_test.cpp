// Journals: what is read is what was written, bit by bit, wherever the file was cut or damaged.
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/journal/journal_reader.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using testing::HasSubstr;

std::uint64_t Bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void ExpectSameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(Bits(a[k]), Bits(b[k])) << k;
}

void ExpectSame(const TickRecord& a, const TickRecord& b)
{
  EXPECT_EQ(a.state.tick, b.state.tick);
  EXPECT_EQ(a.state.last, b.state.last);
  EXPECT_EQ(a.save, b.save);
  EXPECT_EQ(a.state.moved, b.state.moved);
  EXPECT_EQ(a.state.attributes.slots, b.state.attributes.slots);
  ExpectSameBits(a.state.attributes.values, b.state.attributes.values);
  ExpectSameBits(a.state.poses, b.state.poses);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t k = 0; k < a.frames.size(); ++k)
  {
    EXPECT_EQ(b.frames[k].engine, k);
    ExpectSameBits(a.frames[k].values, b.frames[k].values);
  }
  ASSERT_EQ(a.commands.size(), b.commands.size());
  for (std::size_t k = 0; k < a.commands.size(); ++k)
  {
    EXPECT_EQ(b.commands[k].host, k);
    EXPECT_EQ(a.commands[k].attributes.slots, b.commands[k].attributes.slots);
    ExpectSameBits(a.commands[k].attributes.values, b.commands[k].attributes.values);
    ExpectSameBits(a.commands[k].values, b.commands[k].values);
    EXPECT_EQ(a.commands[k].faults, b.commands[k].faults);
  }
}

// Two engines, one of which has sensors, and two hosts.
std::vector<TickRecord> SomeTicks(std::size_t count, unsigned seed)
{
  constexpr double kOdd[] = {0.0, -0.0, 5e-324, -1e308, 1e308, 0.1};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> real(-10, 10);
  std::vector<TickRecord> records(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    TickRecord& record = records[t];
    record.state.tick = t;
    record.save = random() % 3 == 0;
    record.state.last = t + 1 == count;
    for (int k = 0; k < 14; ++k)
      record.state.poses.push_back(random() % 10 == 0 ? kOdd[random() % 6] : 0.01 * static_cast<double>(t) + k);
    for (std::uint32_t slot = 0; slot < 9; ++slot)
      if (random() % 3 == 0) record.state.attributes.Add(slot, real(random));
    if (random() % 4 == 0) record.state.moved = {1, 7};
    // The frames of the first tick are never sent.
    if (t > 0) record.frames = {{t, 0, {}}, {t, 1, {real(random), 0.25, -0.0}}};
    record.commands = {{t, 0, {real(random), 1}, {}, {}}, {t, 1, {}, record.state.attributes, {}}};
    if (random() % 5 == 0) record.commands[1].faults = {{3, 8}, {FaultKind::kTooSlow, FaultKind::kDied}};
  }
  return records;
}

class JournalTest : public testing::Test
{
protected:
  std::string File(const std::string& name) const { return (folder_ / name).string(); }

  static std::vector<char> Start()
  {
    return ContentOf(JournalStart{{7, {{"libx.so", "abc"}}}, HostTable{2, {1, 0}}, 0});
  }

  // Writes each tick in a separate block, and states saved at tick 4. At tick 6 a part is missing.
  std::vector<TickRecord> WriteSome(const std::string& name, std::size_t count)
  {
    const std::vector<TickRecord> records = SomeTicks(count, 3);
    JournalWriter journal(File(name), Start());
    for (const TickRecord& record : records)
    {
      if (record.state.tick == 4 || record.state.tick == 6)
      {
        SpaceSnapshot snapshot;
        snapshot.tick = record.state.tick;
        snapshot.poses = record.state.poses;
        snapshot.attributes = {0, 1, 0.5 * static_cast<double>(record.state.tick)};
        journal.Add(snapshot);
        journal.Add(record.state.tick, {kServerPart, {'s'}});
        if (record.state.tick == 4) journal.Add(record.state.tick, {"engine 'ground'", {'e', '4'}});
      }
      journal.AddTick(record.state, record.save, record.frames, record.commands);
      journal.Flush();
    }
    return records;
  }

  std::vector<TickRecord> Read(const JournalReader& journal) const
  {
    std::vector<TickRecord> records;
    journal.ForEachTick([&](const TickRecord& record) { records.push_back(record); });
    return records;
  }

  const test::TemporaryFolder folder_;
};

// A stated count of frames or commands takes no memory before their bytes are there. In a block of one tick without
// both, their counts are the last eight bytes.
TEST(JournalBlock, StatesNoMoreThanItHas)
{
  for (const std::size_t from_end : {8U, 4U})
  {
    SpaceState state;
    state.poses = {1, 2, 3, 0, 0, 0, 1};
    TickRows rows;
    ASSERT_TRUE(rows.Add(state, false, {}, {}));
    ReusedMemory memory;
    const std::span<const char> content = rows.Content(memory);
    std::vector<char> block(content.begin(), content.end());
    TickRecord record;
    EXPECT_TRUE(TickRecordReader(block, 1, true).Next(record));
    std::fill_n(block.end() - static_cast<std::ptrdiff_t>(from_end), 4, '\xff');
    EXPECT_THROW(TickRecordReader(block, 1, true).Next(record), std::runtime_error);
  }
}

TEST_F(JournalTest, TicksComeBackBitByBitHoweverManyAreInABlock)
{
  const std::vector<TickRecord> records = SomeTicks(1000, 1);
  {
    JournalWriter journal(File("j"), Start());
    for (const TickRecord& record : records) journal.AddTick(record.state, record.save, record.frames, record.commands);
  }
  const JournalReader journal(File("j"));
  EXPECT_EQ(journal.TornBytes(), 0U);
  EXPECT_EQ(journal.Start().hosts, (HostTable{2, {1, 0}}));
  EXPECT_EQ(journal.Start().origin.experiment, 7U);
  ASSERT_EQ(journal.Start().origin.libraries.size(), 1U);
  EXPECT_EQ(journal.Start().origin.libraries[0].build, "abc");
  const std::vector<TickRecord> read = Read(journal);
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t t = 0; t < read.size(); ++t) ExpectSame(records[t], read[t]);
}

TEST_F(JournalTest, SmoothMotionTakesATenthOfItsBytes)
{
  SpaceState state;
  state.poses.resize(700);
  {
    JournalWriter journal(File("j"), Start());
    for (; state.tick < 640; ++state.tick)
    {
      for (std::size_t k = 0; k < state.poses.size(); ++k)
        state.poses[k] = 0.001 * static_cast<double>(state.tick * (k % 7)) + static_cast<double>(k);
      journal.AddTick(state, false, {}, {});
    }
  }
  EXPECT_LT(fs::file_size(File("j")), 640 * 700 * sizeof(double) / 10);
}

// A file that was cut anywhere has all blocks that were whole before the cut, and nothing else.
TEST_F(JournalTest, CutAnywhereItLosesTheLastUnfinishedBlockAlone)
{
  const std::vector<TickRecord> records = WriteSome("whole", 12);
  const JournalReader whole(File("whole"));
  ASSERT_EQ(Read(whole).size(), records.size());
  std::ifstream file(File("whole"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::uint64_t start = whole.Places().front().bytes;
  for (std::size_t length = 0; length < bytes.size(); ++length)
  {
    std::ofstream(File("cut"), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(length));
    if (length < start)
    {
      EXPECT_THROW(JournalReader(File("cut")), std::runtime_error) << length;
      continue;
    }
    const JournalReader cut(File("cut"));
    std::size_t left = 0;
    while (left < whole.Places().size() && whole.Places()[left].offset + whole.Places()[left].bytes <= length) ++left;
    ASSERT_EQ(cut.Places().size(), left) << length;
    const std::uint64_t end = cut.Places().back().offset + cut.Places().back().bytes;
    EXPECT_EQ(cut.TornBytes(), length - end);
    if (cut.TornBytes() != 0) continue;
    const std::vector<TickRecord> read = Read(cut);
    for (std::size_t t = 0; t < read.size(); ++t) ExpectSame(records[t], read[t]);
  }
}

// In each byte of each block: what the block is of, how long it is, its checksum and its content.
TEST_F(JournalTest, AFlippedBitAnywhereIsFoundAndCostsItsBlockAlone)
{
  WriteSome("whole", 8);
  const JournalReader whole(File("whole"));
  const std::vector<JournalPlace>& places = whole.Places();
  std::fstream file(File("whole"), std::ios::in | std::ios::out | std::ios::binary);
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::uint64_t at = places[k].offset; at < places[k].offset + places[k].bytes; ++at)
    {
      file.seekg(static_cast<std::streamoff>(at));
      const auto byte = static_cast<char>(file.get());
      const auto put = [&](char value)
      {
        file.seekp(static_cast<std::streamoff>(at));
        file.put(value).flush();
      };
      put(static_cast<char>(byte ^ (1 << at % 8)));
      const JournalReader hit(File("whole"));
      put(byte);
      SCOPED_TRACE(fmt::format("byte {} of block {}", at - places[k].offset, k));
      // The last block may look as if the run had died while it was written.
      if (k + 1 == places.size() && hit.TornBytes() != 0)
      {
        EXPECT_EQ(hit.TornBytes(), places[k].bytes);
      }
      else
      {
        ASSERT_EQ(hit.Damages(), (std::vector<JournalDamage>{{File("whole"), places[k].offset, places[k].bytes}}));
      }
      EXPECT_EQ(hit.HasStart(), k != 0);
      std::vector<std::uint64_t> left;
      for (const JournalPlace& place : hit.Places()) left.push_back(place.offset);
      std::vector<std::uint64_t> expected;
      for (std::size_t other = 0; other < places.size(); ++other)
        if (other != k && (k != 0 || places[other].kind != JournalBlockKind::kPart))
          expected.push_back(places[other].offset);
      EXPECT_EQ(left, expected);
    }
  EXPECT_TRUE(JournalReader(File("whole")).Damages().empty());
}

// The next block is found even if the magic number of a block is damaged.
TEST_F(JournalTest, DamageOfManyBlocksIsOnePlace)
{
  WriteSome("j", 8);
  const std::vector<JournalPlace> places = JournalReader(File("j")).Places();
  {
    std::fstream file(File("j"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(places[2].offset));
    file << std::string(places[5].offset - places[2].offset, 'x');
  }
  const JournalReader hit(File("j"));
  EXPECT_EQ(hit.Damages(),
            (std::vector<JournalDamage>{{File("j"), places[2].offset, places[5].offset - places[2].offset}}));
  EXPECT_EQ(hit.Places().size(), places.size() - 3);
}

// A machine that loses its power leaves zeros where it had not written yet.
TEST_F(JournalTest, ZerosAtTheEndAreATornEnd)
{
  WriteSome("j", 4);
  const std::uint64_t whole = fs::file_size(File("j"));
  fs::resize_file(File("j"), whole + 4096);
  const JournalReader torn(File("j"));
  EXPECT_EQ(torn.TornBytes(), 4096U);
  EXPECT_TRUE(torn.Damages().empty());
}

TEST_F(JournalTest, AJournalOfWhichNothingButItsStartIsLostSaysSo)
{
  WriteSome("j", 4);
  {
    std::fstream file(File("j"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(20);
    file.put('x');
  }
  const JournalReader journal(File("j"));
  EXPECT_EQ(Read(journal).size(), 4U);
  EXPECT_THROW(journal.Start(), std::runtime_error);
  EXPECT_THROW(journal.Hosts(), std::runtime_error);
  EXPECT_THROW(journal.HostsAt(2), std::runtime_error);
  EXPECT_FALSE(journal.KnowsHostsAt(2));
}

TEST(ReadableTicks, GoOnAtTheNextSavedStateAfterAGap)
{
  const auto ticks = [](std::uint64_t first, std::uint32_t count)
  { return JournalPlace{JournalBlockKind::kTicks, first, count, {}, 0, 0, 0, 0}; };
  const auto state = [](std::uint64_t tick)
  { return JournalPlace{JournalBlockKind::kSnapshot, tick, 0, {}, 0, 0, 0, 0}; };
  const JournalStart start{};
  using Ranges = std::vector<TickRange>;
  EXPECT_EQ(ReadableTicks(start, {ticks(0, 10), ticks(10, 5)}), (Ranges{{0, 15}}));
  EXPECT_EQ(ReadableTicks(start, {}), Ranges{});
  EXPECT_EQ(ReadableTicks(start, {ticks(0, 10), ticks(20, 10)}), (Ranges{{0, 10}}));
  EXPECT_EQ(ReadableTicks(start, {ticks(0, 10), ticks(20, 10), state(25)}), (Ranges{{0, 10}, {25, 30}}));
  EXPECT_EQ(ReadableTicks(start, {ticks(0, 10), state(20), ticks(20, 10), state(25)}), (Ranges{{0, 10}, {20, 30}}));
  EXPECT_EQ(ReadableTicks(start, {ticks(0, 10), state(19), ticks(20, 10)}), (Ranges{{0, 10}, {20, 30}}));
  EXPECT_EQ(ReadableTicks(start, {ticks(0, 10), state(18), ticks(20, 10)}), (Ranges{{0, 10}}));
  EXPECT_EQ(ReadableTicks(start, {state(5), ticks(3, 10)}), (Ranges{{5, 13}}));
}

TEST_F(JournalTest, ACheckpointIsWhatAllSavedAtItsTick)
{
  WriteSome("j", 12);
  const JournalReader journal(File("j"));
  const auto checkpoint = journal.CheckpointAt(4, {kServerPart, "engine 'ground'"});
  ASSERT_TRUE(checkpoint);
  EXPECT_EQ(checkpoint->snapshot.tick, 4U);
  EXPECT_EQ(checkpoint->snapshot.attributes, (std::vector<double>{0, 1, 2}));
  ASSERT_EQ(checkpoint->parts.size(), 2U);
  EXPECT_EQ(checkpoint->parts[1].state, (std::vector<char>{'e', '4'}));
  EXPECT_EQ(journal.CheckpointAt(6, {kServerPart})->snapshot.tick, 6U);
  EXPECT_FALSE(journal.CheckpointAt(6, {kServerPart, "engine 'ground'"}));
  EXPECT_FALSE(journal.CheckpointAt(4, {kServerPart, "controller host 0"}));
  EXPECT_FALSE(journal.CheckpointAt(5, {kServerPart}));
}

TEST_F(JournalTest, ARunGoesOnAtTheNewestTickThatTheServerSavedAndOfWhichTheRecordIsThere)
{
  WriteSome("j", 12);
  const JournalReader journal(File("j"));
  const auto any = [](std::uint64_t) { return true; };
  EXPECT_EQ(journal.RestartTick(any), 6U);
  EXPECT_EQ(journal.RestartTick([](std::uint64_t tick) { return tick != 6; }), 4U);
  EXPECT_EQ(journal.RecordOf(6)->state.tick, 6U);
  EXPECT_FALSE(journal.RecordOf(12));
  // The cut is before the record of tick 6, so its sensor frames are missing for a restart there.
  const auto& places = journal.Places();
  const auto sixth = std::find_if(places.begin(), places.end(),
                                  [](const JournalPlace& place)
                                  { return place.kind == JournalBlockKind::kTicks && place.first_tick == 6; });
  fs::resize_file(File("j"), sixth->offset);
  EXPECT_EQ(JournalReader(File("j")).RestartTick(any), 4U);
}

// Repeated ticks replace the earlier ones for any sizes of blocks and any torn end, several times.
TEST_F(JournalTest, WhatIsDoneAgainTakesThePlaceOfWhatStoodThere)
{
  const std::vector<TickRecord> records = SomeTicks(1000, 1), others = SomeTicks(1000, 2);
  const auto add = [](JournalWriter& journal, const TickRecord& record)
  { journal.AddTick(record.state, record.save, record.frames, record.commands); };
  {
    JournalWriter journal(File("j"), Start());
    for (std::size_t t = 0; t < 500; ++t) add(journal, records[t]);
    journal.Add(400, {kServerPart, {'a'}});
    journal.Add(401, {kServerPart, {'b'}});
  }
  std::ofstream(File("j"), std::ios::app) << kJournalMagic << kJournalVersion << "torn";
  EXPECT_GT(JournalReader(File("j")).TornBytes(), 0U);
  for (const std::uint64_t tick : {400U, 150U})
  {
    {
      JournalWriter journal(JournalReader(File("j")), tick);
      for (std::size_t t = tick; t < tick + 100; ++t) add(journal, others[t]);
    }
    const JournalReader journal(File("j"));
    EXPECT_EQ(journal.TornBytes(), 0U);
    const std::vector<TickRecord> read = Read(journal);
    ASSERT_EQ(read.size(), tick + 100);
    for (std::size_t t = 0; t < tick; ++t) ExpectSame(records[t], read[t]);
    for (std::size_t t = tick; t < read.size(); ++t) ExpectSame(others[t], read[t]);
    const auto parts = std::count_if(journal.Places().begin(), journal.Places().end(),
                                     [](const JournalPlace& place) { return place.kind == JournalBlockKind::kPart; });
    EXPECT_EQ(parts, tick == 400 ? 1 : 0);
  }
}

TEST_F(JournalTest, FaultsOfControllersAreFoundFromATickOn)
{
  const std::vector<TickRecord> records = SomeTicks(300, 4);
  {
    JournalWriter journal(File("j"), Start());
    for (const TickRecord& record : records) journal.AddTick(record.state, record.save, record.frames, record.commands);
  }
  const JournalReader journal(File("j"));
  for (const std::uint64_t from : {0U, 100U, 299U, 300U})
  {
    std::vector<RecordedFault> expected;
    for (std::uint64_t tick = from; tick < records.size(); ++tick)
    {
      const ControllerFaults& faults = records[tick].commands[1].faults;
      for (std::size_t k = 0; k < faults.robots.size(); ++k)
        expected.push_back({tick, faults.robots[k], faults.kinds[k]});
    }
    const RecordedFaults found = journal.FaultsFrom(from, 0);
    EXPECT_EQ(found.faults, expected);
    EXPECT_EQ(found.until, from == 300 ? 0 : 300);
    EXPECT_TRUE(!expected.empty() || from > 100);
    // Where commands act a tick later, they are of the steps before.
    const RecordedFaults late = journal.FaultsFrom(from, 1);
    for (RecordedFault& fault : expected) --fault.tick;
    std::erase_if(expected, [&](const RecordedFault& fault) { return fault.tick + 1 == from; });
    EXPECT_EQ(late.faults, expected);
    EXPECT_EQ(late.until, from >= 299 ? 0 : 299);
  }
}

TEST_F(JournalTest, WhatTheWriterRemembersHasALimitAndAllBlocksAreFoundAgain)
{
  JournalWriter journal(File("j"), Start());
  SpaceState state;
  std::size_t most = 0, blocks = 1;
  for (; state.tick < 12000; ++state.tick, ++blocks)
  {
    // Rows of another length than those before begin a block.
    state.poses.assign(1 + state.tick % 2, 1.0);
    journal.AddTick(state, false, {}, {});
    if (state.tick % 1000 != 999) continue;
    SpaceSnapshot snapshot;
    snapshot.tick = state.tick;
    journal.Add(snapshot);
    journal.Add(state.tick, {kServerPart, {'s'}});
    blocks += 2;
    journal.Flush();
    most = std::max(most, journal.RecentPlaces().size());
  }
  EXPECT_LT(most, 4097U);
  EXPECT_GT(most, 2000U) << "those that a recovery needs are remembered";
  const std::vector<JournalPlace> all = journal.Places();
  EXPECT_EQ(all.size(), blocks);
  const std::vector<JournalPlace> recent = journal.RecentPlaces();
  for (std::size_t k = 0; k < recent.size(); ++k)
  {
    const JournalPlace& same = all[all.size() - recent.size() + k];
    ASSERT_EQ(recent[k].offset, same.offset);
    EXPECT_EQ(recent[k].name, same.name);
    EXPECT_EQ(recent[k].table, same.table);
  }
}

TEST_F(JournalTest, AFullDiskEndsItWithAWholeBlock)
{
  const std::vector<TickRecord> records = SomeTicks(200, 5);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{3000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::optional<std::string> trouble;
  {
    JournalWriter journal(File("j"), Start());
    for (const TickRecord& record : records)
    {
      journal.AddTick(record.state, record.save, record.frames, record.commands);
      journal.Flush();
    }
    EXPECT_FALSE(journal.Works());
    trouble = journal.TakeTrouble();
    EXPECT_FALSE(journal.TakeTrouble()) << "it is told once";
  }
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_TRUE(trouble);
  EXPECT_THAT(*trouble, HasSubstr("File too large"));
  const JournalReader journal(File("j"));
  EXPECT_EQ(journal.TornBytes(), 0U);
  const std::vector<TickRecord> read = Read(journal);
  ASSERT_GT(read.size(), 1U);
  ASSERT_LT(read.size(), records.size());
  for (std::size_t t = 0; t < read.size(); ++t) ExpectSame(records[t], read[t]);
}

}  // namespace
}  // namespace swarmanoid
