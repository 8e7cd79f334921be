#include "launcher/supervision/progress_display.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <deque>
#include <string>

#include "common/errors/print_error.h"
#include "launcher/supervision/process_log.h"
#include "launcher/supervision/process_state.h"
#include "tests/eventually.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using std::chrono::milliseconds;
using std::chrono::seconds;

class ProgressDisplayTest : public testing::Test
{
protected:
  ProgressDisplayTest() { EXPECT_EQ(pipe(ends_), 0); }
  ~ProgressDisplayTest() override
  {
    close(ends_[0]);
    if (ends_[1] >= 0) close(ends_[1]);
  }
  std::string Written()
  {
    close(ends_[1]);
    ends_[1] = -1;
    std::string text(65536, '\0');
    text.resize(static_cast<std::size_t>(read(ends_[0], text.data(), text.size())));
    return text;
  }

  int ends_[2]{};
  ProgressDisplay::Clock::time_point now_{};
};

TEST_F(ProgressDisplayTest, PlainLinesComeAtChangesAndNowAndThen)
{
  ProgressDisplay display(ProgressDisplay::Style::kPlain, ends_[1]);
  RunProgress progress{"starting", 0, 0, 0, 4, "", 0};
  display.Show(progress, now_);
  progress.phase = "running";
  progress.max = 1000;
  progress.real_time_factor = 10;
  for (std::uint64_t i = 0; i <= 60; ++i)
  {
    progress.tick = i * 10;
    display.Show(progress, now_ + milliseconds(100) * i);
  }
  EXPECT_EQ(Written(),
            "starting, 4 processes\n"
            "running: tick 0 of 1000 (0 %), 10.0x real time, 4 processes\n"
            "running: tick 500 of 1000 (50 %), 10.0x real time, 5 s left, 4 processes\n");
}

TEST_F(ProgressDisplayTest, OtherWorkHasAShareAndATimeThatIsLeft)
{
  ProgressDisplay display(ProgressDisplay::Style::kTerminal, ends_[1]);
  RunProgress progress{"reading", 0, 400, 0, 0, "", 0, false};
  display.Show(progress, now_);
  progress.tick = 100;
  display.Show(progress, now_ + seconds(1));
  display.Clear();
  EXPECT_EQ(Written(), "\rreading: 0 %\x1b[K\rreading: 25 %, 3 s left\x1b[K\r\x1b[K");
}

TEST_F(ProgressDisplayTest, SaysWhoIsWaitedFor)
{
  ProgressDisplay display(ProgressDisplay::Style::kTerminal, ends_[1]);
  display.Show({"running", 3, 0, 0, 4, "controller_host 0", 2.4}, now_);
  display.Note("a word");
  EXPECT_EQ(Written(),
            "\rwaiting for controller_host 0 (2 s): tick 3, 0.0x real time, 4 processes\x1b[K\r\x1b[Ka word\n");
}

TEST_F(ProgressDisplayTest, QuietShowsNotesOnly)
{
  ProgressDisplay display(ProgressDisplay::Style::kQuiet, ends_[1]);
  display.Show({"running", 3, 0, 0, 4, "", 0}, now_);
  display.Note("a word");
  EXPECT_EQ(Written(), "a word\n");
}

TEST(DurationText, ReadsAsPeopleSpeak)
{
  EXPECT_EQ(DurationText(0.25), "250 ms");
  EXPECT_EQ(DurationText(42), "42 s");
  EXPECT_EQ(DurationText(200), "3 min 20 s");
  EXPECT_EQ(DurationText(7500), "2 h 5 min");
}

TEST_F(ProgressDisplayTest, TextOfOthersMovesNoCursor)
{
  ProgressDisplay display(ProgressDisplay::Style::kPlain, ends_[1]);
  display.Note(
      "robot \x1b]0;title\x07'fb_0': \x1b[2J\xc2\x9b"
      "31m failed");
  EXPECT_EQ(Written(), "robot ?]0;title?'fb_0': ?[2J??31m failed\n");
}

TEST(DurationText, ChangesItsUnitAtWholeSecondsMinutesAndHours)
{
  EXPECT_EQ(DurationText(0), "0 ms");
  EXPECT_EQ(DurationText(0.999), "999 ms");
  EXPECT_EQ(DurationText(1), "1 s");
  EXPECT_EQ(DurationText(59), "59 s");
  EXPECT_EQ(DurationText(60), "1 min 0 s");
  EXPECT_EQ(DurationText(3599), "59 min 59 s");
  EXPECT_EQ(DurationText(3600), "1 h 0 min");
}

TEST_F(ProgressDisplayTest, TheTimeThatIsLeftFollowsThePace)
{
  ProgressDisplay display(ProgressDisplay::Style::kTerminal, ends_[1]);
  RunProgress progress{"running", 0, 1000, 1, 0, "", 0};
  const auto show = [&](std::uint64_t tick, int ms)
  {
    progress.tick = tick;
    display.Show(progress, now_ + milliseconds(ms));
  };
  show(0, 0);
  show(50, 400);    // too short for a pace
  show(100, 1000);  // 100 ticks in a second
  show(300, 2000);  // 200 in a second: 0.7 * 100 + 0.3 * 200 = 130
  progress.phase = "paused";
  show(300, 2100);
  show(100, 2200);  // it begins again at an earlier tick
  EXPECT_EQ(Written(),
            "\rrunning: tick 0 of 1000 (0 %), 1.0x real time\x1b[K"
            "\rrunning: tick 50 of 1000 (5 %), 1.0x real time\x1b[K"
            "\rrunning: tick 100 of 1000 (10 %), 1.0x real time, 9 s left\x1b[K"
            "\rrunning: tick 300 of 1000 (30 %), 1.0x real time, 5 s left\x1b[K"
            "\rpaused: tick 300 of 1000 (30 %), 1.0x real time\x1b[K"
            "\rpaused: tick 100 of 1000 (10 %), 1.0x real time\x1b[K");
}

TEST_F(ProgressDisplayTest, IsALineOnTerminalsAndPlainOrQuietElsewhere)
{
  using Style = ProgressDisplay::Style;
  EXPECT_EQ(ProgressDisplay::StyleFor(ends_[1], false), Style::kPlain);
  EXPECT_EQ(ProgressDisplay::StyleFor(ends_[1], true), Style::kQuiet);
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  EXPECT_EQ(ProgressDisplay::StyleFor(terminal, false), Style::kTerminal);
  EXPECT_EQ(ProgressDisplay::StyleFor(terminal, true), Style::kQuiet);
  close(terminal);
}

TEST(ProcessLog, HasAllLinesInItsFileAndTheLastEightInMemory)
{
  const test::TemporaryFolder folder;
  {
    ProcessLog log(folder / "a.log");
    EXPECT_TRUE(log.LastLines().empty());
    for (int k = 0; k < 10; ++k) log.Add(std::to_string(k));
    EXPECT_EQ(log.LastLines(), (std::deque<std::string>{"2", "3", "4", "5", "6", "7", "8", "9"}));
    EXPECT_EQ(log.Trouble(), "");
    EXPECT_EQ(log.Path(), folder / "a.log");
    EXPECT_EQ(folder.Read("a.log"), "0\n1\n2\n3\n4\n5\n6\n7\n8\n9\n");
  }
  ProcessLog(folder / "a.log", true).Add("more");
  EXPECT_EQ(folder.Read("a.log"), "0\n1\n2\n3\n4\n5\n6\n7\n8\n9\nmore\n");
  ProcessLog(folder / "a.log").Add("again");
  EXPECT_EQ(folder.Read("a.log"), "again\n");
  EXPECT_THROW(ProcessLog(folder / "missing" / "a.log"), std::runtime_error);
}

TEST(ProcessLog, HasNoColoursOfTerminals)
{
  const test::TemporaryFolder folder;
  ProcessLog log(folder / "a.log");
  for (const char* line : {"\x1b[31mred\x1b[0m end", "a\x1b[1;32mb", "cut\x1b", "cut\x1b[",
                           "one\x1b"
                           "Mletter",
                           "\x1b[K"})
    log.Add(line);
  EXPECT_EQ(log.LastLines(), (std::deque<std::string>{"red end", "ab", "cut", "cut", "oneletter", ""}));
}

TEST(ProcessLog, StaysReadableIfTheDiskIsFull)
{
  ProcessLog log("/dev/full");
  log.Add("a");
  EXPECT_NE(log.Trouble(), "");
  log.Add("b");
  EXPECT_EQ(log.LastLines(), (std::deque<std::string>{"a", "b"}));
}

TEST(ProcessState, IsThatOfTheSystem)
{
  EXPECT_FALSE(IsAsleep(getpid())) << "it runs";
  EXPECT_FALSE(IsStoppedBySignal(getpid()));
  const pid_t child = fork();
  if (child == 0)
    while (true) pause();
  EXPECT_TRUE(test::Eventually([&] { return IsAsleep(child); }));
  kill(child, SIGSTOP);
  EXPECT_TRUE(test::Eventually([&] { return IsStoppedBySignal(child); }));
  EXPECT_FALSE(IsAsleep(child));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(IsAsleep(child)) << "it is gone";
}

// Every complaint about a script, an exception, a file or another process goes this way.
TEST(PrintError, WritesNoControlCharacters)
{
  testing::internal::CaptureStderr();
  PrintError("scene.lua:3: {}\n", "\x1b[31mno\ttarget\r\x1b[0m \xff €");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "scene.lua:3: ?[31mno\ttarget??[0m ? €\n");
}

}  // namespace
}  // namespace swarmanoid
