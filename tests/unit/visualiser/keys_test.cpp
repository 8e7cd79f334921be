#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "test_folders.h"
#include "visualiser/interaction/frame_schedule.h"
#include "visualiser/interaction/keys.h"
#include "visualiser/interaction/value_history.h"
#include "visualiser/scene/enlargement.h"
#include "visualiser/scene/floor_grid.h"

namespace swarmanoid
{
namespace
{

TEST(Keys, ControlDigitsRecallAndWithShiftStoreTheirViewpoint)
{
  for (int number = 0; number <= 9; ++number)
  {
    const auto recall = CommandOf({'0' + number, true, false});
    ASSERT_TRUE(recall);
    EXPECT_EQ(recall->action, Action::kRecall);
    EXPECT_EQ(recall->number, number);
    const auto store = CommandOf({'0' + number, true, true});
    ASSERT_TRUE(store);
    EXPECT_EQ(store->action, Action::kStore);
    EXPECT_EQ(store->number, number);
    EXPECT_FALSE(CommandOf({'0' + number, false, false}));
  }
}

TEST(Keys, EachPressHasOneMeaning)
{
  std::set<std::tuple<int, bool, bool>> presses;
  for (const KeyBinding& binding : KeyBindings())
    if (binding.action != Action::kMouse)
    {
      EXPECT_TRUE(presses.emplace(binding.press.key, binding.press.ctrl, binding.press.shift).second)
          << binding.meaning;
    }
  EXPECT_EQ(CommandOf({'S', false, false})->action, Action::kShadows);
  EXPECT_FALSE(CommandOf({'S', true, false}));  // left to the panels and the desktop
}

TEST(Keys, APrintedCharacterIsItsOwnNameAndABlankHasAWord)
{
  for (int key = '!'; key <= '~'; ++key) EXPECT_EQ(NameOfKey(key), std::string(1, static_cast<char>(key)));
  EXPECT_EQ(NameOfKey('~' + 1), "");
  EXPECT_NE(NameOfKey(' '), " ");
}

TEST(Keys, TheDocumentationListsThemAll)
{
  std::ifstream file(std::string(SWARMANOID_SOURCE_FOLDER) + "/docs/opengl_render.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const KeyBinding& binding : KeyBindings())
  {
    if (binding.keys.empty()) continue;
    const std::string row = "| " + std::string(binding.keys) + " | " + std::string(binding.meaning) + " |";
    EXPECT_NE(text.str().find(row), std::string::npos) << row;
  }
}

TEST(FrameSchedule, DrawsEveryNthTickAndTheNextOneWhereThatWasMissed)
{
  FrameSchedule schedule(10, 1000, false);
  std::vector<std::uint64_t> drawn;
  for (const std::uint64_t tick : {0, 1, 9, 10, 11, 25, 29, 30})
    if (schedule.AtTick(tick, static_cast<double>(tick))) drawn.push_back(tick);
  EXPECT_EQ(drawn, (std::vector<std::uint64_t>{0, 10, 25, 30}));
}

TEST(FrameSchedule, KeepsToItsRateAndCatchesUpWhenIdle)
{
  FrameSchedule schedule(1, 10, false);
  EXPECT_TRUE(schedule.AtTick(0, 5.0));
  schedule.Drawn(5.0);
  EXPECT_FALSE(schedule.AtTick(1, 5.05));
  EXPECT_FALSE(schedule.AtIdle(5.06));
  EXPECT_TRUE(schedule.AtIdle(5.11));
  schedule.Drawn(5.11);
  EXPECT_FALSE(schedule.AtIdle(5.9));  // nothing new
  schedule.Activity(5.9);
  EXPECT_TRUE(schedule.AtIdle(5.91));
  // A click takes a panel several pictures, even where each of them is slow.
  for (const double now : {5.91, 6.5, 7.1, 7.7})
  {
    EXPECT_TRUE(schedule.AtIdle(now));
    schedule.Drawn(now);
  }
  EXPECT_FALSE(schedule.AtIdle(8.3));
  EXPECT_TRUE(schedule.AtIdle(8.75));  // the panels, once a second
}

TEST(FrameSchedule, FramesThatAreWrittenAreNeverLeftOut)
{
  FrameSchedule schedule(1, 10, true);
  for (std::uint64_t tick = 0; tick < 5; ++tick)
  {
    EXPECT_TRUE(schedule.AtTick(tick, 1 + 0.001 * static_cast<double>(tick)));
    schedule.Drawn(1 + 0.001 * static_cast<double>(tick));
  }
}

TEST(Keys, OnlyThoseThatTurnZoomAndStepRepeatWhileTheyAreHeld)
{
  for (const int key : {keys::kLeft, keys::kRight, keys::kUp, keys::kDown, keys::kPageUp, keys::kPageDown})
    EXPECT_TRUE(MayRepeat(key)) << key;
  for (const char key : {'=', '-', 'N'}) EXPECT_TRUE(MayRepeat(key)) << key;
  for (const int key : {keys::kEscape, keys::kTab, keys::kHome, keys::kEnd, keys::kFunction + 1, int{'F'}, int{'0'}})
    EXPECT_FALSE(MayRepeat(key)) << key;
}

TEST(ValueHistory, KeepsTheLatestPointsInOrder)
{
  ValueHistory history;
  for (int i = 0; i < 5000; ++i) history.Add(0.1 * i, i);
  const auto& points = history.Points();
  EXPECT_GE(points.size(), ValueHistory::kMost);
  EXPECT_LE(points.size(), 2 * ValueHistory::kMost);
  EXPECT_EQ(points.back().value, 4999);
  for (std::size_t p = 1; p < points.size(); ++p) EXPECT_LT(points[p - 1].time, points[p].time);
}

TEST(ValueHistory, AValueOfTheSameTickTakesThePlaceOfTheOneBefore)
{
  ValueHistory history;
  history.Add(1, 5);
  history.Add(1, 6);
  ASSERT_EQ(history.Points().size(), 1u);
  EXPECT_EQ(history.Points()[0].value, 6);
}

TEST(FrameSchedule, DrawsForAWhileAfterInputAndOnceASecondAtRest)
{
  FrameSchedule schedule(1, 10, false);
  EXPECT_TRUE(schedule.AtTick(0, 0));
  schedule.Drawn(0);
  EXPECT_FALSE(schedule.AtIdle(0.5));
  EXPECT_TRUE(schedule.AtIdle(1)) << "panels refresh";
  schedule.Activity(0.5);
  EXPECT_TRUE(schedule.AtIdle(0.5));
  EXPECT_FALSE(schedule.AtIdle(0.05)) << "no faster than its rate";
  for (int frame = 0; frame < 4; ++frame)
  {
    EXPECT_TRUE(schedule.AtIdle(2 + frame)) << "four frames, however slow they are";
    schedule.Drawn(2 + frame);
  }
  EXPECT_FALSE(schedule.AtIdle(5.5));
  schedule.Activity(10);
  for (const double now : {10.0, 10.05, 10.1, 10.2}) schedule.Drawn(now);
  EXPECT_TRUE(schedule.AtIdle(10.35)) << "0.4 s";
  EXPECT_FALSE(schedule.AtIdle(10.45));
}

TEST(ValueHistory, APointThatIsNotLaterReplacesTheLastOne)
{
  ValueHistory history;
  history.Add(1, 5);
  history.Add(1, 6);
  history.Add(0.5, 7);
  ASSERT_EQ(history.Points().size(), 1U);
  EXPECT_EQ(history.Points()[0].time, 1);
  EXPECT_EQ(history.Points()[0].value, 7);
  for (int k = 2; k <= 2400; ++k) history.Add(k, k);
  EXPECT_EQ(history.Points().size(), 2400U);
  history.Add(2401, 0);
  EXPECT_EQ(history.Points().size(), 1201U);
  EXPECT_EQ(history.Points().front().time, 1201);
}

TEST(FloorSpacing, IsTheSmallestWithAtMostFourteenCells)
{
  const std::pair<double, double> rows[] = {{0.5, 0.1}, {1.4, 0.1}, {1.5, 0.25}, {3.5, 0.25}, {3.6, 0.5}, {7, 0.5},
                                            {8, 1},     {14, 1},    {15, 2},     {28, 2},     {70, 5},    {140, 10},
                                            {280, 20},  {700, 50},  {1400, 100}, {9000, 100}};
  for (const auto& [side, spacing] : rows)
  {
    EXPECT_EQ(FloorSpacing({side, 0.2, 1}), spacing) << side;
    EXPECT_EQ(FloorSpacing({0.2, side, 99}), spacing) << side;
  }
}

TEST(Enlargement, GivesSmallRobotsTheLeastWidthUpToEightTimesTheirOwn)
{
  EXPECT_FLOAT_EQ(Enlargement(10, 5), 1);
  EXPECT_FLOAT_EQ(Enlargement(5, 5), 1);
  EXPECT_FLOAT_EQ(Enlargement(2, 5), 2.5F);
  EXPECT_FLOAT_EQ(Enlargement(0.5F, 5), 8);
  EXPECT_FLOAT_EQ(Enlargement(0, 5), 8);
  EXPECT_EQ(EnlargementText(1.1F), "");
  EXPECT_EQ(EnlargementText(1.25F), "robots up to 1.2 times as wide");
  EXPECT_EQ(EnlargementText(2.8F), "robots up to 2.8 times as wide");
}

}  // namespace
}  // namespace swarmanoid
