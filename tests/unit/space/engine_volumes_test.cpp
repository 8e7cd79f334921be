// Volumes of engines: which points they have, and which engines move an entity.
#include "common/experiment/engine_volumes.h"

#include <gmock/gmock.h>

#include "common/math/random.h"
#include "common/messages/assignment.h"
#include "common/plugins/catalogue.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

EngineVolume Within(const std::string& text)
{
  EngineVolume volume;
  EXPECT_EQ(volume.ReadOutlines(text), "") << text;
  return volume;
}

TEST(EngineVolume, WithoutOutlinesItHasAllPoints)
{
  EngineVolume volume;
  EXPECT_TRUE(volume.IsWhole());
  EXPECT_TRUE(volume.Holds({-1e9, 1e9, -5}));
  EXPECT_EQ(volume.Text(), "everywhere");
  EXPECT_EQ(volume.ReadOutlines(" "), "");
  EXPECT_TRUE(volume.IsWhole());
}

TEST(EngineVolume, HeightsReachFromTheLowerOneToBelowTheUpperOne)
{
  EngineVolume volume;
  volume.low = -0.02;
  volume.high = 0.5;
  EXPECT_FALSE(volume.IsWhole());
  EXPECT_TRUE(volume.Holds({7, 7, -0.02}));
  EXPECT_FALSE(volume.Holds({7, 7, 0.5}));
  EXPECT_FALSE(volume.Holds({7, 7, -0.021}));
  EXPECT_EQ(volume.Text(), "everywhere from -0.02 to 0.5 m high");
}

TEST(EngineVolume, TwoCornersAreARectangleInAnyOrder)
{
  for (const char* text : {"1, 2, 4, 3", "4 3 1 2", "1,3  4,2"})
  {
    const EngineVolume volume = Within(text);
    EXPECT_TRUE(volume.Holds({2, 2.5, 0})) << text;
    for (const Vector2& outside : {Vector2(0.9, 2.5), Vector2(4.1, 2.5), Vector2(2, 1.9), Vector2(2, 3.1)})
      EXPECT_FALSE(volume.Holds({outside.x(), outside.y(), 0})) << text << ": " << outside.transpose();
  }
}

TEST(EngineVolume, APolygonWithinAnotherOneIsAHole)
{
  const EngineVolume field = Within("0, 0, 10, 10; 4, 4, 6, 6");
  EXPECT_TRUE(field.Holds({1, 5, 0}));
  EXPECT_FALSE(field.Holds({5, 5, 0}));
  EXPECT_FALSE(field.Holds({11, 5, 0}));
}

TEST(EngineVolume, APolygonNeedNotBeConvex)
{
  const EngineVolume corner = Within("0, 0, 4, 0, 4, 1, 1, 1, 1, 4, 0, 4");
  EXPECT_TRUE(corner.Holds({3, 0.5, 0}));
  EXPECT_TRUE(corner.Holds({0.5, 3, 0}));
  EXPECT_FALSE(corner.Holds({3, 3, 0}));
}

TEST(EngineVolume, VolumesThatShareAnEdgeShareNoPointAndLeaveNoGap)
{
  // A square of 1 m, cut by lines from a point within it to its corners.
  RandomStream random(7, 0, 0, 0);
  for (int trial = 0; trial < 200; ++trial)
  {
    const auto number = [&] { return random.Uniform(); };
    const Vector2 middle(number(), number());
    const std::vector<Vector2> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<EngineVolume> parts(4);
    for (std::size_t k = 0; k < 4; ++k)
    {
      parts[k].outlines = {{corners[k], corners[(k + 1) % 4], middle}};
      if (trial % 2 == 0) std::reverse(parts[k].outlines[0].begin(), parts[k].outlines[0].end());
    }
    for (int point = 0; point < 50; ++point)
    {
      // Half of the points are on a cut, as near as numbers can be.
      const double part = number();
      const Vector2 corner = corners[static_cast<std::size_t>(point % 4)];
      const Vector2 at =
          point % 2 == 0 ? Vector2(number(), number()) : Vector2(corner + part * 0.999 * (middle - corner));
      if (!(at.x() > 0 && at.x() < 1 && at.y() > 0 && at.y() < 1)) continue;
      int holders = 0;
      for (const EngineVolume& volume : parts) holders += volume.Holds({at.x(), at.y(), 0}) ? 1 : 0;
      EXPECT_EQ(holders, 1) << at.transpose() << ", middle " << middle.transpose();
    }
  }
}

TEST(EngineVolume, MistakesInOutlinesAreNamed)
{
  EngineVolume volume;
  EXPECT_THAT(volume.ReadOutlines("1, 2"), HasSubstr("at least two corners"));
  EXPECT_THAT(volume.ReadOutlines("1, 2, 3, 4, 5"), HasSubstr("at least two corners"));
  EXPECT_THAT(volume.ReadOutlines("1, 2, 3, x"), HasSubstr("at least two corners"));
  EXPECT_THAT(volume.ReadOutlines("0, 0, 4, 4;"), HasSubstr("at least two corners"));
  EXPECT_THAT(volume.ReadOutlines("0, 0, 0, 4"), HasSubstr("both x and y must differ"));
}

// Two engines: "west" for x below 2 m, and "rest" for the other half. West serves no torque sensors.
class Choices : public testing::Test
{
protected:
  Choices()
  {
    static const bool registered = []
    {
      PluginCatalogue& catalogue = PluginCatalogue::Instance();
      return catalogue.Add(PluginKind::kEngine, {.label = "volume_west", .channels = {"volume_wheels"}}) &&
             catalogue.Add(PluginKind::kEngine,
                           {.label = "volume_rest", .channels = {"volume_wheels", "volume_torque"}}) &&
             catalogue.Add(PluginKind::kActuator, {.label = "volume_wheels",
                                                   .implementation = "test",
                                                   .channel = "volume_wheels",
                                                   .channel_width = 2}) &&
             catalogue.Add(
                 PluginKind::kSensor,
                 {.label = "volume_torque", .implementation = "test", .channel = "volume_torque", .channel_width = 1});
    }();
    EXPECT_TRUE(registered);
    experiment_.arena_size = {4, 4, 2};
    experiment_.engines.resize(2);
    experiment_.engines[0].id = "west";
    experiment_.engines[0].tag = "volume_west";
    experiment_.engines[0].volume = Within("0, 0, 2, 4");
    experiment_.engines[1].id = "rest";
    experiment_.engines[1].tag = "volume_rest";
    experiment_.engines[1].volume = Within("2, 0, 4, 4");
    ControllerConfiguration driver;
    driver.id = "driver";
    driver.actuators = {{"volume_wheels", "test", {}}};
    ControllerConfiguration feeler = driver;
    feeler.id = "feeler";
    feeler.sensors = {{"volume_torque", "test", {}}};
    experiment_.controllers = {driver, feeler};
  }

  std::uint32_t Add(EntityConfiguration entity, const std::string& controller = "", bool in_both = true)
  {
    entity.controller = controller;
    const std::uint32_t number = test::Add(experiment_, std::move(entity));
    if (in_both) experiment_.engines[1].entities.push_back(number);
    experiment_.engine_choices = FindEngineChoices(experiment_);
    return number;
  }
  std::uint32_t AddFootbot(double x, const std::string& controller = "")
  {
    return Add(test::Entity(EntityKind::kFootbot, "fb_" + std::to_string(experiment_.entities.size()), {x, 1, 0}),
               controller);
  }

  Experiment experiment_;
};

TEST_F(Choices, ThereAreNoneWithoutVolumes)
{
  experiment_.engines[0].volume = experiment_.engines[1].volume = {};
  AddFootbot(1);
  EXPECT_THAT(experiment_.engine_choices.entities, IsEmpty());
  EXPECT_THAT(StartEngines(experiment_), ElementsAre(0));
}

TEST_F(Choices, TheFirstEngineWhoseVolumeHasAnEntityMovesIt)
{
  AddFootbot(1);
  AddFootbot(3);
  AddFootbot(2);
  EXPECT_THAT(StartEngines(experiment_), ElementsAre(0, 1, 1));
  EXPECT_THAT(experiment_.engine_choices.Of(1), ElementsAre(0, 1));
}

TEST_F(Choices, AnEngineWithoutTheDevicesOfARobotNeverMovesIt)
{
  AddFootbot(1, "driver");
  AddFootbot(3, "feeler");
  EXPECT_THAT(experiment_.engine_choices.Of(0), ElementsAre(0, 1));
  EXPECT_THAT(experiment_.engine_choices.Of(1), ElementsAre(1));
}

TEST_F(Choices, BlocksKeepTheirEngineAndWhatCannotMoveHasNone)
{
  Add(test::Entity(EntityKind::kBlock, "box", {3, 1, 0}, Vector3(0.1, 0.1, 0.1), true));
  Add(test::Entity(EntityKind::kBlock, "wall", {1, 1, 0}, Vector3(0.1, 0.1, 0.1), false));
  EXPECT_THAT(experiment_.engine_choices.entities, IsEmpty());
  EXPECT_THAT(StartEngines(experiment_), ElementsAre(1, -1));
}

TEST_F(Choices, AnEntityThatChangesItsEngineIsOwnedAndMirroredByAllOfThem)
{
  AddFootbot(1, "driver");
  AddFootbot(3, "feeler");
  const Assignment assignment = MakeAssignment(experiment_, 1);
  for (const EngineLayout& layout : assignment.engines) EXPECT_THAT(layout.changing, ElementsAre(0));
  EXPECT_THAT(assignment.engines[0].owned, ElementsAre(0));
  EXPECT_THAT(assignment.engines[0].mirrored, ElementsAre(0, 1));
  EXPECT_THAT(assignment.engines[1].owned, ElementsAre(0, 1));
  EXPECT_THAT(assignment.engines[1].mirrored, ElementsAre(0));
  // Both engines get the commands of a robot that changes its engine.
  EXPECT_THAT(assignment.engines[0].commands[0].entities, ElementsAre(0));
  EXPECT_THAT(assignment.engines[1].commands[0].entities, ElementsAre(0, 1));
}

TEST_F(Choices, TheSpaceSaysWhichEngineMovesThem)
{
  AddFootbot(3);
  AddFootbot(1);
  CSwarmanoidSpace space(experiment_);
  EXPECT_FALSE(space.IsMovedBy(0, 0));
  EXPECT_TRUE(space.IsMovedBy(0, 1));
  EXPECT_TRUE(space.IsMovedBy(1, 0));
  EXPECT_EQ(space.EngineBefore(0), 1U);
  const std::uint64_t hash = space.Hash();
  space.SetAttribute(space.EngineSlot(0) + EngineSlots::kEngine, 0);
  EXPECT_TRUE(space.IsMovedBy(0, 0));
  EXPECT_EQ(space.EngineBefore(0), 1U);
  EXPECT_NE(space.Hash(), hash);
}

TEST_F(Choices, OnlyTheServerSetsTheEngineOfAnEntity)
{
  AddFootbot(3);
  const CSwarmanoidSpace space(experiment_);
  const std::string mistake = test::MessageOf<StateError>([&] { CheckAttribute(space, space.EngineSlot(0), 0); });
  EXPECT_THAT(mistake, HasSubstr("the engine and velocity of the footbot 'fb_0' is 0"));
  EXPECT_NO_THROW(CheckAttribute(space, space.EngineSlot(0) + EngineSlots::kVelocity, 0.3));
}

TEST_F(Choices, ASnapshotMayOnlyHaveEnginesThatCanMoveTheEntity)
{
  AddFootbot(3, "feeler");
  const CSwarmanoidSpace space(experiment_);
  SpaceSnapshot snapshot;
  space.WritePoses(snapshot.poses);
  snapshot.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
  EXPECT_NO_THROW(CheckSnapshot(space, snapshot));
  for (const double engine : {0.0, 0.5, 2.0})
  {
    snapshot.attributes[space.EngineSlot(0)] = engine;
    EXPECT_THAT(test::MessageOf<StateError>([&] { CheckSnapshot(space, snapshot); }),
                HasSubstr("it is no engine that can move it"));
  }
}

TEST_F(Choices, OutsideAllVolumesIsAnErrorThatNamesThem)
{
  AddFootbot(1);
  const Assignment assignment = MakeAssignment(experiment_, 1);
  const CSwarmanoidSpace space(experiment_);
  const auto check = [&](double x)
  {
    const std::vector<double> poses{x, 1, 0, 0, 0, 0, 1};
    return test::MessageOf<StateError>([&] { CheckInVolumes(space, 0, assignment.engines[0], poses); });
  };
  EXPECT_EQ(check(1), "");
  EXPECT_EQ(check(3), "");
  EXPECT_EQ(check(-0.25),
            "the footbot 'fb_0' left the volumes of all engines that can move it: it is at -0.25, 1, 0, and they are "
            "'west' within 0, 0, 2, 4, 'rest' within 2, 0, 4, 4; give an engine a larger volume, or write "
            "outside=\"keep\" at <arena_physics>");
  EXPECT_THAT(test::MessageOf<StateError>(
                  [&] {
                    CheckPose(space, 0, {{5, 1, 0}, Quaternion::Identity()});
                  }),
              HasSubstr("would be at 5, 1, 0, outside the volumes"));
}

}  // namespace
}  // namespace swarmanoid
