// The past of a run from its folder, and what a status and a request look like to users.
#include "visualiser/playback_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>

#include "common/checkpoint/checkpoint.h"
#include "common/journal/journal_reader.h"
#include "common/journal/journal_writer.h"
#include "common/space/space.h"
#include "tests/eventually.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/fake_run.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/status_line.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

TEST(TimelineEvents, AreTheCompleteLinesOfTheEventLog)
{
  const test::TemporaryFolder folder;
  EXPECT_TRUE(TimelineEventsOf("").empty());
  EXPECT_TRUE(TimelineEventsOf(folder.Path()).empty());
  folder.Write("events.csv",
               "tick,what,entity,numbers,from\n"
               "3,move,fb_0,1 2 0,anna@lab:3\n"
               "5,pause,\n"
               "nonsense\n"
               "9,stop,,,me\n"
               "12,move,fb_1,cut of");
  EXPECT_THAT(
      TimelineEventsOf(folder.Path()),
      ElementsAre(TimelineEvent{3, "move", "fb_0", "anna@lab:3"}, TimelineEvent{5, "pause", "", ""},
                  TimelineEvent{5, "line 4 of events.csv is damaged", "", ""}, TimelineEvent{9, "stop", "", "me"}));
}

// The answers of a reader, collected from its thread.
class PlaybackReaderTest : public testing::Test
{
protected:
  PlaybackReaderTest() : world_({4, 4, 2}) { world_.Add(EntityKind::kFootbot, "fb", {1, 1, 0}); }
  // Writes a journal of ten ticks from tick 0, in which the robot is at x = tick / 10.
  void WriteJournal(std::uint64_t experiment) const
  {
    std::filesystem::create_directories(folder_ / "journal");
    JournalWriter journal(JournalFile(folder_.Path()), ContentOf(JournalStart{{experiment, {}}, {}, 0}));
    for (SpaceState state; state.tick < 10; ++state.tick)
    {
      state.poses = {static_cast<double>(state.tick) / 10, 0, 0, 0, 0, 0, 1};
      journal.AddTick(state, false, {}, {});
    }
    journal.Flush();
  }
  std::unique_ptr<PlaybackReader> Make()
  {
    const auto note = [this](const std::string& text)
    {
      const std::lock_guard lock(mutex_);
      answers_.push_back(text);
    };
    LookBackAnswers answers;
    answers.timeline = [=](const JournalTimeline& timeline)
    { note(fmt::format("timeline {} to {}, {} events", timeline.first, timeline.end, timeline.events.size())); };
    answers.past = [=](std::uint64_t client, const LookBackRequest& request, const CSwarmanoidSpace& space)
    {
      note(fmt::format("{} sees tick {}: x {} and {} entities", client, space.GetTick(), space.GetPose(0).position.x(),
                       request.entities.size()));
    };
    answers.refused = [=](std::uint64_t client, const std::string& text) { note(fmt::format("{}: {}", client, text)); };
    return std::make_unique<PlaybackReader>(world_.GetExperiment(), folder_.Path(), answers);
  }
  // Returns whether this answer came.
  bool Gets(const std::string& answer)
  {
    return test::Eventually(
        [&]
        {
          const std::lock_guard lock(mutex_);
          return std::ranges::find(answers_, answer) != answers_.end();
        });
  }

  const test::TemporaryFolder folder_;
  SmallWorld world_;
  std::mutex mutex_;  // guards answers_
  std::vector<std::string> answers_;
};

TEST_F(PlaybackReaderTest, ShowsTheTicksOfTheJournalAndNoOthers)
{
  WriteJournal(FingerprintOf(world_.GetExperiment()));
  folder_.Write("events.csv", "tick,what,entity,numbers,from\n3,pause,,,\n");
  const std::unique_ptr<PlaybackReader> reader = Make();
  EXPECT_EQ(reader->RunFolder(), folder_.Path());
  EXPECT_TRUE(Gets("timeline 0 to 10, 1 events"));
  reader->Ask(4, {7, {0, 1}});
  EXPECT_TRUE(Gets("4 sees tick 7: x 0.7 and 1 entities")) << "entity 1 does not exist";
  reader->Ask(5, {0, {}});
  EXPECT_TRUE(Gets("5 sees tick 0: x 0 and 0 entities"));
  reader->Ask(4, {9, {}});
  EXPECT_TRUE(Gets("4 sees tick 9: x 0.9 and 0 entities"));
  reader->Ask(4, {10, {}});
  EXPECT_TRUE(Gets("4: nothing can be shown of tick 10: the journal has ticks 0 to 9, and not 10"));
  folder_.Write("events.csv", "tick,what,entity,numbers,from\n3,pause,,,\n4,resume,,,\n");
  reader->Refresh();
  EXPECT_TRUE(Gets("timeline 0 to 10, 2 events"));
}

TEST_F(PlaybackReaderTest, NeedsAJournalOfThisExperiment)
{
  const std::unique_ptr<PlaybackReader> reader = Make();
  reader->Ask(1, {0, {}});
  EXPECT_TRUE(Gets("1: nothing can be shown of tick 0: the run keeps no journal here"));
  WriteJournal(FingerprintOf(world_.GetExperiment()) + 1);
  reader->Ask(2, {0, {}});
  EXPECT_TRUE(Gets("2: nothing can be shown of tick 0: the run keeps no journal here"));
}

TEST(RunFolder, IsThatOfARunOrTheOneThatTheMonitorKnows)
{
  const test::TemporaryFolder folder;
  test::FakeMonitor monitor;
  monitor.run_folder = "/elsewhere";
  EXPECT_EQ(RunFolderOf(folder.Path(), nullptr), "") << "it has no manifest";
  EXPECT_EQ(RunFolderOf(folder.Path(), &monitor), "/elsewhere");
  EXPECT_EQ(RunFolderOf("", &monitor), "/elsewhere");
  folder.Write("manifest.json", "{}");
  EXPECT_EQ(RunFolderOf(folder.Path() + "/.", &monitor),
            std::filesystem::path(folder.Path() + "/.").lexically_normal());
}

TEST(PhaseName, IsOneOfFiveWords)
{
  using enum RunStatus::Phase;
  EXPECT_EQ(PhaseName(kUnknown), "unknown");
  EXPECT_EQ(PhaseName(kWaiting), "waiting");
  EXPECT_EQ(PhaseName(kRunning), "running");
  EXPECT_EQ(PhaseName(kPaused), "paused");
  EXPECT_EQ(PhaseName(kFinished), "finished");
}

TEST(StatusLine, HasThePaceOfARunningRunAndTheLateProcesses)
{
  RunStatus status;
  status.tick = 120;
  status.phase = RunStatus::Phase::kRunning;
  status.real_time_factor = 12.5;
  status.ticks_per_second = 125;
  EXPECT_EQ(StatusLine(status), "tick 120, running, 12.5x real time, 125 ticks/s");
  status.speed_wanted = 20;
  status.processes.resize(3);
  status.processes[0].name = "space server";
  status.processes[1].name = "controller host 1";
  status.processes[1].late_s = 2.1;
  status.processes[1].doing = "runs the controller of fb_3";
  status.processes[2].name = "engine worker 2";
  status.processes[2].late_s = 0.5;
  EXPECT_EQ(StatusLine(status),
            "tick 120, running, 12.5x real time (wanted: 20x), 125 ticks/s; late: controller host 1 (2.1 s, runs the "
            "controller of fb_3), engine worker 2 (0.5 s)");
  status.processes.clear();
  status.phase = RunStatus::Phase::kFinished;
  status.ended = "goal reached";
  EXPECT_EQ(StatusLine(status), "tick 120, finished (goal reached)");
}

TEST(ExperimentControl, ShortWaysAreRequestsOfTheTable)
{
  test::FakeControl control;
  control.Pause();
  control.Resume();
  control.Step(7);
  control.SetSpeed(2.5);
  control.RemoveEntity("fb_0");
  control.PressKey("space", true);
  control.PressKey("space", false);
  control.SelectEntity("fb_1");
  control.SelectEntity("");
  control.Stop();
  control.Reset();
  EXPECT_THAT(control.asked, ElementsAre("pause", "resume", "step 7", "speed 2.5", "remove fb_0", "press space",
                                         "release space", "select fb_1", "deselect", "stop", "reset"));
  control.asked.clear();
  const Pose pose{{1, 2, 3}, QuaternionFromEuler({0.1, 0.2, 0.3})};
  control.AddEntity("fb_2", pose);
  control.MoveEntity("fb_3", pose);
  EXPECT_THAT(control.asked, ElementsAre("add fb_2", "move fb_3"));
  using testing::DoubleNear;
  EXPECT_THAT(control.place,
              ElementsAre(1, 2, 3, DoubleNear(RadiansToDegrees(0.1), 1e-9), DoubleNear(RadiansToDegrees(0.2), 1e-9),
                          DoubleNear(RadiansToDegrees(0.3), 1e-9)));
}

}  // namespace
}  // namespace swarmanoid
