// The messages to users about an incomplete journal.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "simulation/playback/journal_loss.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class JournalLossTest : public testing::Test
{
protected:
  JournalLossTest()
  {
    fs::create_directory(folder_ / "journal");
    JournalWriter journal(Path(), ContentOf(JournalStart{{7, {}}, HostTable{1, {0}}, 0}));
    SpaceState state;
    state.poses.assign(7, 1.0);
    for (; state.tick < 20; ++state.tick)
    {
      if (state.tick == 10) journal.Add(SpaceSnapshot{.tick = 10, .poses = state.poses, .attributes = {}});
      journal.AddTick(state, false, {}, {});
      journal.Flush();
    }
  }
  std::string Path() const { return (folder_ / "journal/0").string(); }
  void Damage(std::uint64_t at)
  {
    std::fstream file(Path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(at));
    file.put('\x7e');
  }
  std::uint64_t OffsetOfTick(std::uint64_t tick) const
  {
    const JournalReader journal(Path());
    for (const JournalPlace& place : journal.Places())
      if (place.kind == JournalBlockKind::kTicks && place.first_tick == tick) return place.offset;
    return 0;
  }
  JournalLoss Loss(std::optional<std::uint64_t> last_tick = 19) const
  {
    return FindLoss(JournalReader(Path()), {.last_tick = last_tick, .has_budget = false, .trouble = {}});
  }

  const test::TemporaryFolder folder_;
};

TEST_F(JournalLossTest, OfAWholeJournalNothingIsSaid)
{
  EXPECT_FALSE(Loss().is_damaged);
  EXPECT_THAT(Loss().notes, IsEmpty());
  EXPECT_THAT(Loss(std::nullopt).notes, IsEmpty());
}

TEST_F(JournalLossTest, TheByteAndTheTicksUpToTheNextSavedStateAreNamed)
{
  const std::uint64_t at = OffsetOfTick(4);
  Damage(at + 60);
  const JournalLoss loss = Loss();
  EXPECT_TRUE(loss.is_damaged);
  EXPECT_THAT(loss.notes, ElementsAre(HasSubstr(fmt::format("'{}' is damaged at byte {}", Path(), at)),
                                      "6 of 20 states are lost: ticks 4 to 9"));
}

TEST_F(JournalLossTest, AfterTheLastSavedStateAllIsLost)
{
  Damage(OffsetOfTick(15) + 60);
  EXPECT_THAT(Loss().notes, Contains("5 of 20 states are lost: ticks 15 to 19"));
}

TEST_F(JournalLossTest, ADamagedSavedStateCostsNoTick)
{
  const JournalReader journal(Path());
  for (const JournalPlace& place : journal.Places())
    if (place.kind == JournalBlockKind::kSnapshot) Damage(place.offset + 50);
  EXPECT_TRUE(Loss().is_damaged);
  EXPECT_THAT(Loss().notes, Contains("no state is lost"));
}

TEST_F(JournalLossTest, ATornEndIsToldAndIsDamageOnlyIfTheRunEndedLater)
{
  fs::resize_file(Path(), fs::file_size(Path()) - 3);
  const JournalLoss died = Loss(std::nullopt);
  EXPECT_FALSE(died.is_damaged);
  EXPECT_THAT(died.notes, ElementsAre(AllOf(HasSubstr("torn end"), HasSubstr("after tick 18"),
                                            HasSubstr("was killed while it wrote them"))));
  const JournalLoss ended = Loss(19);
  EXPECT_TRUE(ended.is_damaged);
  EXPECT_THAT(ended.notes, ElementsAre(HasSubstr("torn end"), "1 of 20 states are lost: ticks 19"));
}

TEST_F(JournalLossTest, AnEndThatWasCutAtABlockIsMissedByTheManifest)
{
  fs::resize_file(Path(), OffsetOfTick(12));
  EXPECT_FALSE(Loss(std::nullopt).is_damaged);
  EXPECT_TRUE(Loss(19).is_damaged);
  EXPECT_THAT(Loss(19).notes, ElementsAre("8 of 20 states are lost: ticks 12 to 19"));
}

TEST_F(JournalLossTest, AJournalThatGoesOnBehindTheEndOfTheRunIsTold)
{
  EXPECT_TRUE(Loss(15).is_damaged);
  EXPECT_THAT(Loss(15).notes, Contains(HasSubstr("has ticks up to 19, but the run ended at tick 15")));
}

TEST_F(JournalLossTest, WithoutItsFirstBlockTheStatesAreStillRead)
{
  Damage(20);
  EXPECT_TRUE(Loss().is_damaged);
  EXPECT_THAT(Loss().notes, Contains("no state is lost"));
}

TEST_F(JournalLossTest, OldestSegmentsMayBeMissingOnlyWithABudget)
{
  fs::copy_file(Path(), folder_ / "journal/3");
  fs::remove(Path());
  RecordedEnd end{.last_tick = 19, .has_budget = true, .trouble = {}};
  EXPECT_FALSE(FindLoss(JournalReader(Path()), end).is_damaged);
  end.has_budget = false;
  const JournalLoss loss = FindLoss(JournalReader(Path()), end);
  EXPECT_TRUE(loss.is_damaged);
  EXPECT_THAT(loss.notes, Contains(HasSubstr("segments before")));
}

TEST_F(JournalLossTest, TheManifestSaysWhereTheRunEndedAndADamagedOneIsTold)
{
  const auto write = [&](const std::string& text) { std::ofstream(folder_ / "manifest.json") << text; };
  EXPECT_FALSE(RecordedEndOf(folder_.Path()).last_tick) << "a run without a manifest";
  write(R"({"command": ["swarmanoid", "run", "--journal-budget=1GiB"], "ticks": 19})");
  const RecordedEnd end = RecordedEndOf(folder_.Path());
  EXPECT_EQ(end.last_tick, 19U);
  EXPECT_TRUE(end.has_budget);
  EXPECT_THAT(end.trouble, IsEmpty());
  for (const char* text : {"", "{", R"({"command": ["run"], "ticks": "19"})", R"({"command": ["run", 7]})", "[]"})
  {
    write(text);
    const RecordedEnd damaged = RecordedEndOf(folder_.Path());
    EXPECT_THAT(damaged.trouble, HasSubstr("manifest.json' is damaged")) << text;
    EXPECT_TRUE(FindLoss(JournalReader(Path()), damaged).is_damaged) << text;
  }
}

}  // namespace
}  // namespace swarmanoid
