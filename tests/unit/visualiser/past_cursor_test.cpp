// Looking back in a window, over a journal that was written before.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "common/configuration/xml_reader.h"
#include "common/journal/journal_reader.h"
#include "common/journal/journal_writer.h"
#include "common/plugin_descriptions/renderers.h"
#include "tests/eventually.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/fake_run.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/interaction/past_cursor.h"
#include "visualiser/interaction/viewer.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr std::uint64_t kTicks = 300;

// A footbot drives along x, 1 cm a tick, in a run whose journal has its first 300 ticks.
class PastTest : public testing::Test
{
protected:
  PastTest() : world_({4, 4, 2})
  {
    world_.Add(EntityKind::kFootbot, "fb", {0, 1, 0}).controller = "driver";
    fs::create_directory(folder_ / "journal");
    folder_.Write("events.csv",
                  "tick,event,entity,value,from,text\n40,move,fb,,somebody@here,\n120,pause,,,,\n121,resume,,,,\n");
    JournalStart start;
    start.origin.experiment = FingerprintOf(world_.GetExperiment());
    JournalWriter journal(JournalFile(folder_.Path()), ContentOf(start));
    for (SpaceState state; state.tick < kTicks; ++state.tick)
    {
      state.poses = {0.01 * static_cast<double>(state.tick), 1, 0, 0, 0, 0, 1};
      journal.AddTick(state, false, {}, {});
    }
    journal.Flush();
  }
  // Until the journal's thread has answered.
  bool Until(PastCursor& past, PastCursor::Clock::time_point now, const std::function<bool()>& met)
  {
    return test::Eventually(
        [&]
        {
          past.Advance(now);
          return met();
        });
  }
  std::unique_ptr<PastCursor> Open()
  {
    auto past = std::make_unique<PastCursor>(world_.GetExperiment());
    past->Follow(folder_.Path());
    EXPECT_TRUE(Until(*past, {}, [&] { return past->IsThere(); }));
    return past;
  }
  static double X(const CSwarmanoidSpace& space) { return space.GetPose(0).position.x(); }

  const test::TemporaryFolder folder_{"of the past"};
  SmallWorld world_;
};

TEST_F(PastTest, OfManyTicksThatAreAskedForTheLastOneIsShown)
{
  const auto past = Open();
  EXPECT_EQ(past->First(), 0u);
  EXPECT_EQ(past->Last(), kTicks - 1);
  for (std::uint64_t tick = 7; tick <= 250; tick += 27) past->Look(tick);
  EXPECT_TRUE(Until(*past, {}, [&] { return past->Space() != nullptr && past->Space()->GetTick() == 250; }));
  EXPECT_DOUBLE_EQ(X(*past->Space()), 2.5);
  past->Look(1000);
  EXPECT_EQ(past->Wanted(), kTicks - 1) << "the nearest that there is";
  past->GoLive();
  EXPECT_EQ(past->Space(), nullptr);
  past->Advance({});
  EXPECT_EQ(past->Space(), nullptr) << "what comes late is not shown";
}

TEST_F(PastTest, PlaysInRealTimeUpToThePresent)
{
  const auto past = Open();
  const PastCursor::Clock::time_point start{seconds(1000)};
  past->Look(100);
  past->TogglePlay(start);
  EXPECT_TRUE(past->IsPlaying());
  EXPECT_TRUE(Until(*past, start + seconds(5), [&] { return past->Space() && past->Space()->GetTick() == 150; }));
  past->TogglePlay(start + seconds(5));
  EXPECT_FALSE(past->IsPlaying());
  EXPECT_EQ(past->Wanted(), 150u);
  past->Advance(start + seconds(9));
  EXPECT_EQ(past->Wanted(), 150u) << "it stands";
  past->TogglePlay(start);
  EXPECT_TRUE(Until(*past, start + seconds(60), [&] { return !past->IsOn(); }));
  EXPECT_FALSE(past->IsPlaying());
}

TEST_F(PastTest, JumpsFromEventToEvent)
{
  const auto past = Open();
  EXPECT_TRUE(Until(*past, {}, [&] { return past->Events().size() == 3; }));
  EXPECT_EQ(past->Events()[0].from, "somebody@here");
  EXPECT_EQ(past->Neighbour(false), 121u) << "of the present";
  EXPECT_EQ(past->Neighbour(true), std::nullopt);
  past->Look(120);
  EXPECT_EQ(past->Neighbour(false), 40u);
  EXPECT_EQ(past->Neighbour(true), 121u);
}

TEST_F(PastTest, AnotherRunHasAnotherPast)
{
  const auto past = Open();
  past->Look(10);
  past->Follow((folder_ / "next").string());
  EXPECT_FALSE(past->IsOn());
  EXPECT_FALSE(past->IsThere());
  past->Look(10);
  past->TogglePlay({});
  EXPECT_FALSE(past->IsOn()) << "it has no journal";
}

class PastViewerTest : public PastTest
{
protected:
  PastViewerTest()
  {
    world_.Space().SetTick(kTicks + 50);
    world_.Space().SetPose(0, {{3.5, 1, 0}, Quaternion::Identity()});
    monitor_.run_folder = folder_.Path();
    monitor_.inside.entity = 0;
    assignment_.owner = assignment_.host = {-1};
  }
  Viewer& Make(const std::string& elements = "")
  {
    const TConfigurationTree tree(ReadXml("<opengl_render>" + elements + "</opengl_render>", "test.xml"));
    viewer_ = std::make_unique<Viewer>(
        RenderSetup{Parameters(tree, description_.parameters), world_.Space(), assignment_, "", &control_, &monitor_},
        800, 600);
    return *viewer_;
  }
  bool Until(const std::function<bool()>& met)
  {
    return test::Eventually(
        [&]
        {
          viewer_->FollowPast();
          return met();
        });
  }

  const PluginDescription description_ = OpenGlRenderDescription();
  Assignment assignment_;
  test::FakeControl control_;
  test::FakeMonitor monitor_;
  std::unique_ptr<Viewer> viewer_;
};

TEST_F(PastViewerTest, ShowsThePastAndNobodyChangesIt)
{
  Viewer& viewer = Make();
  ASSERT_TRUE(Until([&] { return viewer.GetPast().IsThere(); }));
  EXPECT_EQ(&viewer.Refresh().Space(), &world_.Space());
  EXPECT_NE(viewer.Robot(0), nullptr);
  viewer.Press({','});
  ASSERT_TRUE(Until([&] { return viewer.Space().GetTick() == kTicks - 2; }));
  viewer.Press({','});
  viewer.Press({','});
  ASSERT_TRUE(Until([&] { return viewer.Space().GetTick() == kTicks - 4; }));
  EXPECT_DOUBLE_EQ(X(viewer.Space()), 0.01 * (kTicks - 4));
  EXPECT_EQ(&viewer.Refresh().Space(), &viewer.Space());
  EXPECT_EQ(viewer.Robot(0), nullptr);
  EXPECT_FALSE(viewer.Motion(0)) << "its speed at that tick is not known";
  EXPECT_EQ(viewer.Present().GetTick(), kTicks + 50);
  viewer.MoveEntity(0, {});
  EXPECT_THAT(control_.asked, testing::IsEmpty());
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("Q goes back"));

  viewer.Press({'B', false, true});
  EXPECT_EQ(viewer.TakeCopy(), fmt::format("swarmanoid run --branch '{}@{}'", folder_.Path(), kTicks - 4));
  viewer.Press({'I', false, true});
  EXPECT_EQ(viewer.TakeCopy(), "") << "no robot is selected";
  viewer.Select(0);
  viewer.Press({'I', false, true});
  EXPECT_EQ(viewer.TakeCopy(), fmt::format("swarmanoid inspect '{}@{}' fb", folder_.Path(), kTicks - 4));
  viewer.Press({'Q'});
  EXPECT_EQ(&viewer.Refresh().Space(), &world_.Space());
  viewer.MoveEntity(0, {});
  EXPECT_THAT(control_.asked, testing::ElementsAre("move fb"));
}

TEST_F(PastViewerTest, PlotsGoOnWithThePresent)
{
  Viewer& viewer = Make();
  viewer.SetPlotted({0, ValueGroup::Source::kPose, "pose", "x"}, "m", true);
  ASSERT_TRUE(Until([&] { return viewer.GetPast().IsThere(); }));
  viewer.LookBackAt(100);
  ASSERT_TRUE(Until([&] { return viewer.Space().GetTick() == 100; }));
  viewer.StateCame();
  ASSERT_FALSE(viewer.Plots()[0].history.Points().empty());
  EXPECT_DOUBLE_EQ(viewer.Plots()[0].history.Points().back().value, 3.5);
}

TEST_F(PastViewerTest, TheCameraFollowsWhatIsShown)
{
  Viewer& viewer = Make();
  ASSERT_TRUE(Until([&] { return viewer.GetPast().IsThere(); }));
  viewer.Select(0);
  viewer.follows = true;
  viewer.StateCame();
  viewer.LookBackAt(100);
  ASSERT_TRUE(Until([&] { return viewer.Space().GetTick() == 100; }));
  const Vector3 before = viewer.camera.position;
  viewer.StateCame();
  EXPECT_EQ(viewer.camera.position, before) << "the present does not move it";
  viewer.LookBackAt(150);
  ASSERT_TRUE(Until([&] { return viewer.Space().GetTick() == 150; }));
  EXPECT_NEAR(viewer.camera.position.x() - before.x(), 0.5, 1e-12);
}

TEST_F(PastViewerTest, FramesAreOfThePresentAlone)
{
  Viewer& viewer = Make("<write_frames>true</write_frames>");
  viewer.FollowPast();
  viewer.Press({','});
  EXPECT_FALSE(viewer.GetPast().IsOn());
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("writes frames"));
}

}  // namespace
}  // namespace swarmanoid
