// Tests the input of a user at a window, without the window: keys, mouse, selection, filter, plots, requests to the
// run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "common/configuration/xml_reader.h"
#include "common/messages/control_verbs.h"
#include "common/plugin_descriptions/renderers.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/fake_run.h"
#include "visualiser/interaction/viewer.h"

namespace swarmanoid
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ViewerTest : public ::testing::Test
{
protected:
  static constexpr int kWidth = 800;
  static constexpr int kHeight = 600;

  ViewerTest() : world_({4, 4, 2}), description_(OpenGlRenderDescription())
  {
    world_.Add(EntityKind::kFootbot, "fb_0", {1, 1, 0});
    world_.Add(EntityKind::kFootbot, "fb_1", {3, 3, 0});
    world_.Add(EntityKind::kEyebot, "eb", {1, 3, 1});
    world_.AddBody(EntityKind::kBlock, "stone", {3, 1, 0.1}, {0.4, 0.4, 0.2});
    monitor_.inside.entity = 99;
    monitor_.status.phase = RunStatus::Phase::kRunning;
    world_.GetExperiment().clock_tick_ms = 100;
  }

  Viewer& Make(const std::string& elements = "", bool control = true)
  {
    assignment_.owner.assign(world_.Space().Size(), -1);
    assignment_.host.assign(world_.Space().Size(), -1);
    const TConfigurationTree tree(ReadXml("<opengl_render>" + elements + "</opengl_render>", "test.xml"));
    viewer_ = std::make_unique<Viewer>(RenderSetup{Parameters(tree, description_.parameters), world_.Space(),
                                                   assignment_, "", control ? &control_ : nullptr, &monitor_},
                                       kWidth, kHeight);
    return *viewer_;
  }

  Vector3 OnScreen(const Vector3& point) const { return viewer_->camera.Project(point, kWidth, kHeight); }
  Vector3 OnScreen(const std::string& id) { return OnScreen(world_[id].GetPosition() + Vector3(0, 0, 0.05)); }
  void Click(const Vector3& place, bool ctrl = false)
  {
    viewer_->MousePress(MouseButton::kLeft, place.x(), place.y(), ctrl, false);
    viewer_->MouseRelease(MouseButton::kLeft);
  }
  std::uint32_t Index(const std::string& id) { return world_[id].GetIndex(); }

  SmallWorld world_;
  PluginDescription description_;
  Assignment assignment_;
  test::FakeControl control_;
  test::FakeMonitor monitor_;
  std::unique_ptr<Viewer> viewer_;
};

TEST_F(ViewerTest, StartsAtTheFirstViewpointAndRecallsTheOthers)
{
  Viewer& viewer = Make(
      "<camera_view_XYZ_0>3.30811, 3.36071, 1.0</camera_view_XYZ_0><camera_view_HPR_0>39, -34, 0</camera_view_HPR_0>"
      "<camera_view_XYZ_2>7, 6.5, 0.83</camera_view_XYZ_2><camera_view_HPR_2>-155, 0, 0</camera_view_HPR_2>");
  EXPECT_DOUBLE_EQ(viewer.camera.position.x(), 3.30811);
  EXPECT_DOUBLE_EQ(viewer.camera.pitch, -34);
  viewer.Press({'2', true});
  EXPECT_DOUBLE_EQ(viewer.camera.position.y(), 6.5);
  EXPECT_DOUBLE_EQ(viewer.camera.heading, -155);
  viewer.Press({'5', true});  // the experiment does not define view 5
  EXPECT_DOUBLE_EQ(viewer.camera.position.y(), 6.5);
  EXPECT_TRUE(viewer.Messages().back().refused);
}

TEST_F(ViewerTest, StoresTheViewThatIsThereAndWritesItAsXml)
{
  Viewer& viewer = Make();
  viewer.camera.position = {1.5, -2, 3.25};
  viewer.camera.heading = 40;
  viewer.camera.pitch = -12.5;
  ::testing::internal::CaptureStdout();
  viewer.Press({'7', true, true});
  EXPECT_EQ(::testing::internal::GetCapturedStdout(),
            "<camera_view_XYZ_7>1.5, -2, 3.25</camera_view_XYZ_7>\n"
            "<camera_view_HPR_7>40, -12.5, 0</camera_view_HPR_7>\n");
  viewer.Press({keys::kEnd});
  EXPECT_LT(viewer.camera.pitch, -80);
  viewer.Press({'7', true});
  EXPECT_DOUBLE_EQ(viewer.camera.pitch, -12.5);
}

TEST_F(ViewerTest, AClickSelectsAndInspectsOneBesideTheFloorNone)
{
  Viewer& viewer = Make();
  Click(OnScreen("fb_1"));
  EXPECT_EQ(viewer.shown.scene.selected, Index("fb_1"));
  EXPECT_THAT(viewer.Inspected(), ElementsAre(Index("fb_1")));
  Click(OnScreen("eb"));
  EXPECT_THAT(viewer.Inspected(), ElementsAre(Index("eb")));
  Click(OnScreen("fb_0"), true);
  EXPECT_THAT(viewer.Inspected(), ElementsAre(Index("eb"), Index("fb_0")));
  Click(OnScreen(Vector3(2, 2, 0)));
  EXPECT_FALSE(viewer.shown.scene.selected);
  EXPECT_EQ(viewer.Inspected().size(), 2u);
  viewer.CloseInspector(Index("eb"));
  EXPECT_THAT(viewer.Inspected(), ElementsAre(Index("fb_0")));
}

TEST_F(ViewerTest, WatchesTheRobotsThatAreInspectedOrPlotted)
{
  Viewer& viewer = Make();
  viewer.Refresh();
  EXPECT_THAT(monitor_.watched, IsEmpty());
  viewer.Select(Index("fb_1"));
  viewer.SetPlotted({Index("fb_0"), ValueGroup::Source::kPose, "pose", "speed"}, "m/s", true);
  viewer.Refresh();
  EXPECT_THAT(monitor_.watched, ElementsAre(Index("fb_0"), Index("fb_1")));
  viewer.CloseInspector(Index("fb_1"));
  viewer.Refresh();
  EXPECT_THAT(monitor_.watched, ElementsAre(Index("fb_0")));
}

TEST_F(ViewerTest, PlotsSpeedAndReadingsOverSimulatedTime)
{
  Viewer& viewer = Make();
  const std::uint32_t robot = Index("fb_0");
  viewer.SetPlotted({robot, ValueGroup::Source::kPose, "pose", "speed"}, "m/s", true);
  viewer.SetPlotted({robot, ValueGroup::Source::kSensor, "footbot_proximity", "3"}, "", true);
  monitor_.inside.entity = robot;
  monitor_.inside.sensors = {{"footbot_proximity", {{"2", "", 0.5}, {"3", "", 0}}}};
  for (int tick = 0; tick < 5; ++tick)
  {
    world_.Space().SetTick(static_cast<std::uint64_t>(tick));
    world_.Space().SetPose(robot, {{1 + 0.03 * tick, 1, 0}, Quaternion::Identity()});
    monitor_.inside.sensors[0].readings[1].value = 0.1 * tick;
    viewer.StateCame();
  }
  const auto& speed = viewer.Plots()[0].history.Points();
  ASSERT_EQ(speed.size(), 5u);
  EXPECT_NEAR(speed.back().time, 0.4, 1e-12);
  EXPECT_NEAR(speed.back().value, 0.3, 1e-9);  // 3 cm in a tenth of a second
  EXPECT_NEAR(viewer.Plots()[1].history.Points().back().value, 0.4, 1e-12);
  EXPECT_EQ(viewer.Plots()[1].title, "fb_0 footbot_proximity 3");
}

TEST_F(ViewerTest, KeysPauseStepAndChangeTheSpeed)
{
  Viewer& viewer = Make();
  viewer.Press({' '});
  monitor_.status.phase = RunStatus::Phase::kPaused;
  viewer.Press({'N'});
  viewer.Press({'N', false, true});
  viewer.Press({' '});
  monitor_.status.speed_wanted = 2;
  viewer.Press({'='});
  viewer.Press({'-'});
  monitor_.status.speed_wanted = 100;
  viewer.Press({'='});  // the next speed is as fast as possible
  monitor_.status.speed_wanted = 0;
  viewer.Press({'-'});
  EXPECT_THAT(control_.asked,
              ElementsAre("pause", "step 1", "step 10", "resume", "speed 5", "speed 1", "speed 0", "speed 100"));
}

TEST_F(ViewerTest, ShiftDragAsksForThePlaceUnderTheMouse)
{
  Viewer& viewer = Make();
  const Vector3 from = OnScreen(Vector3(1, 1, 0));
  const Vector3 to = OnScreen(Vector3(2.5, 1.5, 0));
  viewer.MousePress(MouseButton::kLeft, from.x(), from.y() - 1, false, true);
  ASSERT_TRUE(viewer.MoveUnderWay());
  viewer.MouseMove(to.x(), to.y() - 1);
  viewer.Wheel(2, to.x(), to.y());  // 30 degrees
  EXPECT_THAT(control_.asked, IsEmpty());
  viewer.MouseRelease(MouseButton::kLeft);
  EXPECT_THAT(control_.asked, ElementsAre("move fb_0"));
  EXPECT_NEAR(control_.place.at(0), 2.5, 0.02);
  EXPECT_NEAR(control_.place.at(1), 1.5, 0.02);
  EXPECT_DOUBLE_EQ(control_.place.at(2), 0);
  EXPECT_NEAR(control_.place.at(5), 30, 1e-9);
  EXPECT_EQ(world_["fb_0"].GetPosition(), Vector3(1, 1, 0));  // that is for the space server to do
}

TEST_F(ViewerTest, WhatStandsFastOrMayOnlyBeWatchedIsNotMoved)
{
  Viewer& viewer = Make();
  const Vector3 stone = OnScreen("stone");
  viewer.MousePress(MouseButton::kLeft, stone.x(), stone.y(), false, true);
  EXPECT_FALSE(viewer.MoveUnderWay());
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("'stone' stands fast"));
  Viewer& watcher = Make("", false);
  const Vector3 robot = OnScreen("fb_0");
  watcher.MousePress(MouseButton::kLeft, robot.x(), robot.y(), false, true);
  EXPECT_FALSE(watcher.MoveUnderWay());
  watcher.Press({' '});
  EXPECT_THAT(watcher.Messages().back().text, HasSubstr("may only watch"));
}

TEST_F(ViewerTest, SaysWhatCameOfRequestsOnce)
{
  Viewer& viewer = Make();
  monitor_.notes = {{3, true, "moved 'fb_0' at tick 3", "here:1"},
                    {4, false, "move: there is no entity 'x'", "here:2"}};
  viewer.Refresh();
  viewer.Refresh();
  ASSERT_EQ(viewer.Messages().size(), 2u);
  EXPECT_FALSE(viewer.Messages()[0].refused);
  EXPECT_TRUE(viewer.Messages()[1].refused);
  // A list that is full loses its oldest.
  monitor_.notes.erase(monitor_.notes.begin());
  monitor_.notes.push_back({5, true, "paused", "here:1"});
  viewer.Refresh();
  EXPECT_EQ(viewer.Messages().size(), 3u);
  EXPECT_EQ(viewer.Messages().back().text, "paused");
}

TEST_F(ViewerTest, FollowsTheSelectedEntity)
{
  Viewer& viewer = Make();
  viewer.Select(Index("fb_0"));
  viewer.Press({'F'});
  viewer.StateCame();
  const Vector3 before = viewer.camera.position;
  world_.Space().SetPose(Index("fb_0"), {{1.5, 1.2, 0}, Quaternion::Identity()});
  viewer.StateCame();
  EXPECT_TRUE((viewer.camera.position - before).isApprox(Vector3(0.5, 0.2, 0), 1e-9));
}

TEST_F(ViewerTest, KeysAndSelectionsGoToExperimentFunctionsUntilTheyAreTheWindowsAgain)
{
  Viewer& viewer = Make();
  viewer.Press({keys::kFunction + 8});
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("no functions"));
  world_.GetExperiment().functions.emplace_back();
  viewer.Select(Index("fb_0"));
  EXPECT_THAT(control_.asked, IsEmpty());
  viewer.Press({keys::kFunction + 8});
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("go to the experiment functions"));
  viewer.Press({'I'});
  viewer.Press({'I'});  // it is held
  EXPECT_FALSE(viewer.shown.scene.ids) << "which is what it does in the window";
  viewer.Press({keys::kUp});
  viewer.Release('I');
  viewer.Release('I');
  viewer.Select(Index("fb_1"));
  viewer.Press({'0', true});
  viewer.Press({keys::kFunction + 8});
  EXPECT_THAT(control_.asked,
              ElementsAre("select fb_0", "press I", "press Up", "release I", "select fb_1", "release Up", "deselect"));
  control_.asked.clear();
  viewer.Press({'I'});
  viewer.Release('I');
  EXPECT_TRUE(viewer.shown.scene.ids);
  EXPECT_THAT(control_.asked, IsEmpty());
  Viewer& watcher = Make("", false);
  watcher.Press({keys::kFunction + 8});
  EXPECT_THAT(watcher.Messages().back().text, HasSubstr("may only watch"));
}

TEST_F(ViewerTest, FollowsNobodyOutOfTheArena)
{
  Viewer& viewer = Make();
  const std::uint32_t fb = Index("fb_0");
  viewer.Select(fb);
  viewer.Press({'F'});
  viewer.StateCame();
  const Vector3 before = viewer.camera.position;
  world_.Space().SetAttribute(world_.Space().PresenceSlot(fb), 0);
  viewer.StateCame();
  viewer.Visit(fb);
  EXPECT_EQ(viewer.camera.position, before);
  EXPECT_EQ(viewer.Messages().back().text, "'fb_0' is not in the arena");
  // Where it comes back it is followed from.
  world_.Space().SetAttribute(world_.Space().PresenceSlot(fb), 1);
  world_.Space().SetPose(fb, {{2, 2, 0}, Quaternion::Identity()});
  viewer.StateCame();
  EXPECT_EQ(viewer.camera.position, before);
  world_.Space().SetPose(fb, {{2, 2.5, 0}, Quaternion::Identity()});
  viewer.StateCame();
  EXPECT_TRUE((viewer.camera.position - before).isApprox(Vector3(0, 0.5, 0), 1e-9));
}

TEST_F(ViewerTest, DraggingTurnsAndShiftsTheView)
{
  Viewer& viewer = Make();
  const Camera before = viewer.camera;
  viewer.MousePress(MouseButton::kLeft, 400, 300, false, false);
  viewer.MouseMove(500, 300);
  viewer.MouseRelease(MouseButton::kLeft);
  EXPECT_NEAR(viewer.camera.heading, before.heading - 30, 1e-6);
  EXPECT_FALSE(viewer.shown.scene.selected);
  // The point under the mouse follows it.
  const Vector3 floor = PointOnFloor(viewer.camera.RayThrough(400, 300, kWidth, kHeight), 0, 10);
  viewer.MousePress(MouseButton::kRight, 400, 300, false, false);
  viewer.MouseMove(440, 280);
  viewer.MouseRelease(MouseButton::kRight);
  EXPECT_NEAR(OnScreen(floor).x(), 440, 0.5);
  EXPECT_NEAR(OnScreen(floor).y(), 280, 0.5);
}

TEST_F(ViewerTest, TheWholeArenaIsFittedBesidePanelsButAnInspectorMovesNoPicture)
{
  Viewer& viewer = Make();
  const HiddenEdges panels{0.3, 0, 0.1};
  const auto expect_beside = [&](const HiddenEdges& hidden)
  {
    for (const double x : {0.0, 4.0})
      for (const double y : {0.0, 4.0})
      {
        const Vector3 corner = OnScreen(Vector3(x, y, 0));
        EXPECT_GT(corner.x(), hidden.left * kWidth);
        EXPECT_LT(corner.x(), (1 - hidden.right) * kWidth);
        EXPECT_GT(corner.y(), 0);
        EXPECT_LT(corner.y(), (1 - hidden.bottom) * kHeight);
      }
  };
  viewer.SetSize(kWidth, kHeight, panels);
  expect_beside(panels);
  const Vector3 before = viewer.camera.position;
  const HiddenEdges inspector{0.3, 0.3, 0.1};
  viewer.SetSize(kWidth, kHeight, inspector);
  EXPECT_EQ(viewer.camera.position, before);
  for (const Action action : {Action::kFromAbove, Action::kWholeArena})
  {
    viewer.Do({action});
    expect_beside(inspector);
  }
}

TEST_F(ViewerTest, TheFilterLooksInAllColumnsOrInOne)
{
  EntityFilter& filter = Make().Filter();
  EXPECT_EQ(filter.Matching("").size(), world_.Space().Size());
  EXPECT_THAT(filter.Matching("FB"), ElementsAre(Index("fb_0"), Index("fb_1")));
  EXPECT_THAT(filter.Matching("foot 1"), ElementsAre(Index("fb_1")));
  EXPECT_THAT(filter.Matching("kind:eye"), ElementsAre(Index("eb")));
  EXPECT_THAT(filter.Matching("id:eye"), IsEmpty());
}

TEST_F(ViewerTest, ValuesReadAsPeopleReadThem)
{
  Make();
  world_.Set("fb_0", "led", 0xff0000, 3);
  world_.Set("fb_0", "gripped", 1 + Index("stone"));
  const auto groups = ValuesOf(world_.Space(), Index("fb_0"), {}, nullptr);
  const auto text = [&](const std::string& name)
  {
    const auto value = FindValue(groups, {Index("fb_0"), ValueGroup::Source::kAttributes, "attributes", name});
    return value ? ValueText(world_.Space(), *value) : "missing";
  };
  EXPECT_EQ(text("led 3"), "#ff0000");
  EXPECT_EQ(text("led 4"), "off");
  EXPECT_EQ(text("gripped"), "stone");
  EXPECT_EQ(text("turret angle"), "0.000 rad");
}

TEST_F(ViewerTest, EachPanelAndOptionIsSwitchedByItsAction)
{
  Viewer& viewer = Make();
  Viewer::Shown& shown = viewer.shown;
  const std::tuple<Action, bool*, bool, const char*> rows[] = {
      {Action::kHelp, &shown.help, false, ""},
      {Action::kRunPanel, &shown.run, true, ""},
      {Action::kEntityPanel, &shown.entities, true, ""},
      {Action::kPlotPanel, &shown.plots, true, ""},
      {Action::kTimelinePanel, &shown.timeline, true, ""},
      {Action::kAllPanels, &shown.panels, true, ""},
      {Action::kTextures, &shown.textures, true, "textures"},
      {Action::kShadows, &shown.shadows, true, "shadows"},
      {Action::kCollisionModels, &shown.scene.collision_models, false, "collision models"},
      {Action::kIds, &shown.scene.ids, false, "ids"},
      {Action::kTrails, &shown.scene.trails, false, "trails"},
      {Action::kRays, &shown.scene.rays, false, "rays"},
      {Action::kBeams, &shown.scene.beams, true, "laser beams"}};
  for (const auto& [action, option, at_first, name] : rows)
    for (const bool now : {!at_first, at_first})
    {
      EXPECT_EQ(*option, !now) << name << static_cast<int>(action);
      viewer.Do({action});
      EXPECT_EQ(*option, now) << name << static_cast<int>(action);
      if (*name == 0) continue;
      EXPECT_EQ(viewer.Messages().back().text, std::string(name) + (now ? " on" : " off"));
    }
}

TEST_F(ViewerTest, ParametersOfTheFileSetTheOptions)
{
  const std::pair<const char*, bool (*)(const Viewer::Shown&)> rows[] = {
      {"use_textures", [](const Viewer::Shown& shown) { return shown.textures; }},
      {"use_shadows", [](const Viewer::Shown& shown) { return shown.shadows; }},
      {"show_ids", [](const Viewer::Shown& shown) { return shown.scene.ids; }},
      {"show_trails", [](const Viewer::Shown& shown) { return shown.scene.trails; }},
      {"show_rays", [](const Viewer::Shown& shown) { return shown.scene.rays; }},
      {"show_collision_models", [](const Viewer::Shown& shown) { return shown.scene.collision_models; }}};
  for (const auto& [name, is_shown] : rows)
    for (const bool wanted : {true, false})
      EXPECT_EQ(is_shown(Make(fmt::format("<{0}>{1}</{0}>", name, wanted)).shown), wanted) << name;
}

TEST_F(ViewerTest, HelpIsShownWithThePanelsAndClosedBeforeTheSelection)
{
  Viewer& viewer = Make();
  viewer.Select(Index("fb_0"));
  viewer.Do({Action::kHelp});
  viewer.Do({Action::kAllPanels});
  EXPECT_FALSE(viewer.shown.panels);
  viewer.Do({Action::kHelp});
  EXPECT_TRUE(viewer.shown.help && viewer.shown.panels) << "hidden panels have no help to close";
  viewer.Do({Action::kDeselect});
  EXPECT_FALSE(viewer.shown.help);
  EXPECT_TRUE(viewer.shown.scene.selected);
  viewer.Do({Action::kDeselect});
  EXPECT_FALSE(viewer.shown.scene.selected);
}

TEST_F(ViewerTest, APictureIsTakenOnceAndAWindowClosesForGood)
{
  Viewer& viewer = Make();
  EXPECT_FALSE(viewer.TakePictureRequest() || viewer.WantsToClose());
  viewer.Do({Action::kPicture});
  EXPECT_TRUE(viewer.TakePictureRequest());
  EXPECT_FALSE(viewer.TakePictureRequest());
  viewer.Do({Action::kClose});
  EXPECT_TRUE(viewer.WantsToClose());
  EXPECT_TRUE(viewer.WantsToClose());
}

TEST_F(ViewerTest, ArrowKeysTurnByFiveDegreesAndZoomByAFactor)
{
  Viewer& viewer = Make();
  const auto change = [&](Action action)
  {
    const Camera before = viewer.camera;
    const Vector3 pivot = PointOnFloor(before.RayThrough(kWidth / 2.0, kHeight / 2.0, kWidth, kHeight), 0, 10);
    viewer.Do({action});
    const double nearer = (viewer.camera.position - pivot).norm() / (before.position - pivot).norm();
    return Vector3(viewer.camera.heading - before.heading, viewer.camera.pitch - before.pitch, nearer);
  };
  const std::pair<Action, Vector3> rows[] = {{Action::kOrbitLeft, {5, 0, 1}}, {Action::kOrbitRight, {-5, 0, 1}},
                                             {Action::kOrbitUp, {0, -5, 1}},  {Action::kOrbitDown, {0, 5, 1}},
                                             {Action::kZoomIn, {0, 0, 0.85}}, {Action::kZoomOut, {0, 0, 1 / 0.85}}};
  for (const auto& [action, wanted] : rows)
  {
    const Vector3 changed = change(action);
    EXPECT_LT((changed - wanted).norm(), 1e-6) << static_cast<int>(action) << ": " << changed.transpose();
  }
  const Vector3 floor = PointOnFloor(viewer.camera.RayThrough(300, 350, kWidth, kHeight), 0, 10);
  const double before = (viewer.camera.position - floor).norm();
  viewer.Wheel(1, 300, 350);
  EXPECT_NEAR((viewer.camera.position - floor).norm() / before, 0.88, 1e-6) << "towards what is under the mouse";
  EXPECT_NEAR(OnScreen(floor).x(), 300, 1e-6);
}

TEST_F(ViewerTest, SpeedsAreTheStepsOfAScaleWithTheFastestAtItsEnd)
{
  Viewer& viewer = Make();
  const double speeds[] = {0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 0};
  std::vector<std::string> wanted;
  for (std::size_t k = 0; k + 1 < std::size(speeds); ++k)
  {
    monitor_.status.speed_wanted = speeds[k];
    viewer.Do({Action::kFaster});
    wanted.push_back(fmt::format("speed {}", speeds[k + 1]));
    monitor_.status.speed_wanted = speeds[k + 1];
    viewer.Do({Action::kSlower});
    wanted.push_back(fmt::format("speed {}", speeds[k]));
  }
  monitor_.status.speed_wanted = 0.1;
  viewer.Do({Action::kSlower});
  wanted.emplace_back("speed 0.1");
  monitor_.status.speed_wanted = 0;
  viewer.Do({Action::kFaster});
  wanted.emplace_back("speed 0");
  EXPECT_EQ(control_.asked, wanted);
}

TEST_F(ViewerTest, OnlyWhoMaySteerSendsRequests)
{
  Viewer& viewer = Make();
  viewer.Reset();
  viewer.SetSpeed(3);
  viewer.MoveEntity(Index("fb_1"), Pose());
  EXPECT_THAT(control_.asked, ElementsAre("reset", "speed 3", "move fb_1"));
  control_.asked.clear();
  Viewer& watcher = Make("", false);
  watcher.Do({Action::kStep});
  EXPECT_THAT(watcher.Messages(), IsEmpty());
  const std::function<void()> requests[] = {[&] { watcher.Reset(); }, [&] { watcher.SetSpeed(3); },
                                            [&] { watcher.MoveEntity(Index("fb_1"), Pose()); },
                                            [&] { watcher.Do({Action::kPause}); }};
  for (std::size_t k = 0; k < std::size(requests); ++k)
  {
    requests[k]();
    ASSERT_EQ(watcher.Messages().size(), k + 1);
    EXPECT_EQ(watcher.Messages().back().text, "this visualisation may only watch");
    EXPECT_TRUE(watcher.Messages().back().refused);
  }
  EXPECT_THAT(control_.asked, IsEmpty());
}

TEST_F(ViewerTest, TheLatestFiveMessagesAreShown)
{
  Viewer& viewer = Make();
  for (int k = 0; k < 7; ++k) viewer.Say(fmt::format("{}", k));
  ASSERT_EQ(viewer.Messages().size(), 5u);
  EXPECT_EQ(viewer.Messages().front().text, "2");
  EXPECT_FALSE(viewer.Messages().front().refused);
}

TEST_F(ViewerTest, AClickMayMoveByFourPixels)
{
  Viewer& viewer = Make();
  const auto drag = [&](double pixels)
  {
    viewer.Deselect();
    const Vector3 place = OnScreen("fb_1");
    viewer.MousePress(MouseButton::kLeft, place.x(), place.y(), false, false);
    viewer.MousePress(MouseButton::kRight, 0, 0, false, false);  // one drag at a time
    viewer.MouseMove(place.x() + pixels, place.y());
    viewer.MouseRelease(MouseButton::kRight);
    viewer.MouseRelease(MouseButton::kLeft);
    return viewer.shown.scene.selected.has_value();
  };
  const Vector3 before = viewer.camera.position;
  EXPECT_TRUE(drag(4));
  EXPECT_EQ(viewer.camera.position, before);
  EXPECT_FALSE(drag(4.5));
  EXPECT_NE(viewer.camera.position, before);
}

TEST_F(ViewerTest, EntitiesAreMovedWithinTheArena)
{
  Viewer& viewer = Make();
  viewer.Do({Action::kFromAbove});
  const Vector3 from = OnScreen(Vector3(1, 1, 0));
  viewer.MousePress(MouseButton::kLeft, from.x(), from.y(), false, true);
  ASSERT_TRUE(viewer.MoveUnderWay());
  const std::pair<Vector3, Vector3> rows[] = {{{-0.5, 2, 0}, {0, 2, 0}},
                                              {{4.5, 2, 0}, {4, 2, 0}},
                                              {{2, -0.5, 0}, {2, 0, 0}},
                                              {{2, 4.5, 0}, {2, 4, 0}},
                                              {{2, 3, 0}, {2, 3, 0}}};
  for (const auto& [to, place] : rows)
  {
    const Vector3 pixel = OnScreen(to);
    viewer.MouseMove(pixel.x(), pixel.y());
    EXPECT_LT((viewer.MoveUnderWay()->pose.position - place).norm(), 0.1) << place.transpose();
  }
}

TEST_F(ViewerTest, AVisitLooksAtTheEntityFromNearby)
{
  Viewer& viewer = Make();
  for (const auto& [pitch, allowed] : {std::pair(-85.0, -60.0), std::pair(0.0, -20.0), std::pair(-40.0, -40.0)})
  {
    viewer.camera.pitch = pitch;
    viewer.camera.roll = 3;
    viewer.Visit(Index("eb"));
    EXPECT_EQ(viewer.camera.pitch, allowed);
    EXPECT_EQ(viewer.camera.roll, 0);
    const Vector3 pixel = OnScreen(Vector3(1, 3, 1));
    EXPECT_NEAR(pixel.x(), kWidth / 2.0, 1e-6);
    EXPECT_NEAR(pixel.y(), kHeight / 2.0, 1e-6);
    EXPECT_NEAR(pixel.z(), 1.2 + 2 * 0.566, 1e-6) << "twice its size, and a bit";
  }
}

TEST_F(ViewerTest, FollowingAndThePastNeedSomethingToFollowAndAJournal)
{
  Viewer& viewer = Make();
  viewer.Do({Action::kFollow});
  EXPECT_FALSE(viewer.follows);
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("click on an entity first"));
  viewer.Select(Index("fb_0"));
  viewer.Do({Action::kFollow});
  EXPECT_TRUE(viewer.follows);
  EXPECT_EQ(viewer.Messages().back().text, "following 'fb_0' on");
  viewer.Do({Action::kWholeArena});
  EXPECT_FALSE(viewer.follows);
  for (const Action action : {Action::kTickBack, Action::kTickForward, Action::kEventBack, Action::kEventForward,
                              Action::kPlayPast, Action::kBranch})
  {
    viewer.Say("");
    viewer.Do({action});
    EXPECT_EQ(viewer.Messages().back().text, "there is nothing to look back at: the run keeps no journal here");
  }
  viewer.Do({Action::kInspectPast});
  EXPECT_THAT(viewer.Messages().back().text, HasSubstr("look back and select a robot"));
  EXPECT_FALSE(viewer.FollowPast());
}

TEST_F(ViewerTest, NumbersHaveThreePlacesOrFourDigits)
{
  Make();
  const auto text = [&](double value, const std::string& unit) { return ValueText(world_.Space(), {"", unit, value}); };
  EXPECT_EQ(text(1.23456, "m"), "1.235 m");
  EXPECT_EQ(text(-0.0004, "m"), "0.000 m");
  EXPECT_EQ(text(-0.0006, ""), "-0.001");
  EXPECT_EQ(text(99999, ""), "99999.000");
  EXPECT_EQ(text(123456, ""), "1.235e+05");
  EXPECT_EQ(text(1, "yes/no"), "yes");
  EXPECT_EQ(text(0, "yes/no"), "no");
  EXPECT_EQ(text(0xffffff, "colour"), "#ffffff");
  EXPECT_EQ(text(0x0a0b0c, "colour"), "#0a0b0c");
  EXPECT_EQ(text(0, "entity"), "none");
  EXPECT_EQ(text(4, "entity"), "stone");
  EXPECT_EQ(text(5, "entity"), "none");
  EXPECT_EQ(WholeNumber(7, 7), 7U);
  EXPECT_FALSE(WholeNumber(8, 7));
  EXPECT_EQ(WholeNumber(0, 7), 0U);
}

TEST_F(ViewerTest, AttributesHaveTheirUnits)
{
  world_.Add(EntityKind::kHandbot, "hb", {2, 2, 0});
  world_.Add(EntityKind::kLightBulb, "light", {2, 2, 1});
  Make();
  const auto unit = [&](const std::string& id, const std::string& name)
  {
    const auto found = FindValue(ValuesOf(world_.Space(), Index(id), {}, nullptr),
                                 {Index(id), ValueGroup::Source::kAttributes, "attributes", name});
    return found ? found->unit : "missing";
  };
  const std::tuple<const char*, const char*, const char*> rows[] = {
      {"fb_0", "led 0", "colour"},         {"fb_0", "led 11", "colour"},
      {"fb_0", "beacon", "colour"},        {"fb_0", "gripped", "entity"},
      {"fb_0", "gripper aperture", "rad"}, {"fb_0", "turret angle", "rad"},
      {"hb", "gripped 1", "entity"},       {"hb", "arm 0", "rad"},
      {"hb", "rope attached", "yes/no"},   {"hb", "rope length", "m"},
      {"eb", "laser", "yes/no"},           {"eb", "laser colour", "colour"},
      {"eb", "laser pan", "rad"},          {"eb", "attached", "yes/no"},
      {"stone", "colour", "colour"},       {"light", "intensity", ""},
      {"fb_0", "message 0", "missing"}};
  for (const auto& [id, name, wanted] : rows) EXPECT_EQ(unit(id, name), wanted) << id << " " << name;
}

// Returns the inspector's lines for one entity: "group.value=text", in its order, without the attributes.
std::vector<std::string> Listed(Viewer& viewer, std::uint32_t entity)
{
  std::vector<std::string> texts;
  for (const ValueGroup& group : ValuesOf(viewer.Space(), entity, viewer.Motion(entity), viewer.Robot(entity)))
    if (group.source != ValueGroup::Source::kAttributes)
      for (const EntityValue& value : group.values)
        texts.push_back(group.name + "." + value.name + "=" + ValueText(viewer.Space(), value));
  return texts;
}

TEST_F(ViewerTest, AnInspectorShowsPoseMotionAndTheInsideOfItsRobotAlone)
{
  Viewer& viewer = Make();
  const std::uint32_t robot = Index("fb_1");
  viewer.Select(robot);
  monitor_.inside.entity = robot;
  monitor_.inside.sensors = {{"light", {{"0", "", 0.5}}}, {"wheels", {{"left", "rad/s", -2}}}};
  monitor_.inside.actuators = {{"wheels", {{"left", "rad/s", 3}, {"right", "rad/s", 4}}}};
  for (int tick = 0; tick < 2; ++tick)
  {
    world_.Space().SetTick(static_cast<std::uint64_t>(tick));
    world_.Space().SetPose(robot, {{3, 3 - 0.05 * tick, 0}, QuaternionFromYaw(DegreesToRadians(175 + 10 * tick))});
    viewer.StateCame();
  }
  // The heading went from 175 to -175 degrees: it turned by 10, not by 350.
  EXPECT_THAT(Listed(viewer, robot),
              ElementsAre("pose.x=3.000 m", "pose.y=2.950 m", "pose.z=0.000 m", "pose.alpha=0.000 degrees",
                          "pose.beta=0.000 degrees", "pose.gamma=-175.000 degrees", "pose.speed=0.500 m/s",
                          "pose.turn=100.000 degrees/s", "light.0=0.500", "wheels.left=-2.000 rad/s",
                          "wheels.left=3.000 rad/s", "wheels.right=4.000 rad/s"));
  EXPECT_THAT(Listed(viewer, Index("fb_0")), testing::SizeIs(8)) << "of another robot";
  EXPECT_THAT(Listed(viewer, Index("stone")), testing::SizeIs(6)) << "what cannot move has no speed";
}

TEST_F(ViewerTest, ASensorAndAnActuatorOfOneTypeAreToldApart)
{
  Viewer& viewer = Make();
  const std::uint32_t robot = Index("fb_0");
  monitor_.inside.entity = robot;
  monitor_.inside.sensors = {{"wheels", {{"left", "rad/s", -2}}}};
  monitor_.inside.actuators = {{"wheels", {{"left", "rad/s", 3}}}};
  const auto groups = ValuesOf(viewer.Space(), robot, {}, viewer.Robot(robot));
  const auto value = [&](ValueGroup::Source source, const std::string& group)
  {
    const auto found = FindValue(groups, {robot, source, group, "left"});
    return found ? found->value : 0;
  };
  EXPECT_EQ(value(ValueGroup::Source::kSensor, "wheels"), -2);
  EXPECT_EQ(value(ValueGroup::Source::kActuator, "wheels"), 3);
  EXPECT_EQ(value(ValueGroup::Source::kActuator, "light"), 0);
}

TEST_F(ViewerTest, ReadingsMayBeAnyNumber)
{
  Make();
  const auto text = [&](double value, const std::string& unit) { return ValueText(world_.Space(), {"", unit, value}); };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(text(kInfinity, "m"), "inf m");
  EXPECT_EQ(text(-kInfinity, ""), "-inf");
  EXPECT_EQ(text(std::nan(""), "rad"), "nan rad");
  for (const double none : {kInfinity, std::nan(""), -1.0, 1e300, 4294967296.0})
  {
    EXPECT_EQ(text(none, "entity"), "none") << none;
    EXPECT_THAT(text(none, "colour"), testing::EndsWith(" colour")) << none;
  }
}

}  // namespace
}  // namespace swarmanoid
