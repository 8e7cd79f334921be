#include "launcher/supervision/progress_display.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/errors/print_error.h"

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

// Every complaint about a script, an exception, a file or another process goes this way.
TEST(PrintError, WritesNoControlCharacters)
{
  testing::internal::CaptureStderr();
  PrintError("scene.lua:3: {}\n", "\x1b[31mno\ttarget\r\x1b[0m \xff €");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "scene.lua:3: ?[31mno\ttarget??[0m ? €\n");
}

}  // namespace
}  // namespace swarmanoid
