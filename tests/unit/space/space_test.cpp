#include "common/space/space.h"

#include <gmock/gmock.h>

#include "common/math/elementary.h"
#include "common/space/space_query.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using test::Entity;

EntityConfiguration Footbot(const std::string& id, const Vector3& position)
{
  return Entity(EntityKind::kFootbot, id, position, {0.085, 0.085, 0.15}, true);
}

EntityConfiguration Block(const std::string& id, const Vector3& position, const Vector3& size)
{
  return Entity(EntityKind::kBlock, id, position, size, false);
}

Experiment TwoWorlds()
{
  Experiment experiment;
  experiment.arena_size = {10, 10, 3};
  experiment.entities = {Footbot("fb0", {1, 1, 0}),
                         Block("wall", {2, 1, 0.25}, {0.1, 8, 0.5}),
                         Footbot("fb1", {3, 1, 0}),
                         Footbot("fb2", {1, 2, 0}),
                         Entity(EntityKind::kCylindricPrey, "prey", {1, 3, 0}, {0.1, 0.1, 0.1}, true),
                         Footbot("alone", {5, 5, 0})};
  experiment.engines.resize(2);
  experiment.engines[0].entities = {0, 1, 2, 3, 4};
  experiment.engines[1].entities = {5};
  return experiment;
}

TEST(Space, StartsAsTheExperimentSays)
{
  const Experiment experiment = TwoWorlds();
  const CSwarmanoidSpace space(experiment);
  EXPECT_EQ(space.GetTick(), 0U);
  EXPECT_EQ(space.FindEntity("fb1")->GetPosition(), Vector3(3, 1, 0));
  EXPECT_EQ(space.FindEntity("nobody"), nullptr);
  EXPECT_THAT(space.Movable(), testing::ElementsAre(0, 2, 3, 4, 5));
  EXPECT_NE(dynamic_cast<const CFootBotEntity*>(space.FindEntity("fb0")), nullptr);
  EXPECT_NE(dynamic_cast<const CCylindricPreyEntity*>(space.FindEntity("prey")), nullptr);
}

TEST(Space, EveryPartOfTheStateIsInTheHash)
{
  const Experiment experiment = TwoWorlds();
  CSwarmanoidSpace space(experiment);
  const std::uint64_t initial = space.Hash();
  EXPECT_EQ(CSwarmanoidSpace(experiment).Hash(), initial);

  space.SetTick(1);
  EXPECT_NE(space.Hash(), initial);
  space.SetTick(0);
  EXPECT_EQ(space.Hash(), initial);

  Pose pose = space.GetPose(2);
  pose.position.z() += 1e-15;
  space.SetPose(2, pose);
  EXPECT_NE(space.Hash(), initial);
  pose.position.z() = 0;
  space.SetPose(2, pose);
  EXPECT_EQ(space.Hash(), initial);

  space.SetAttribute(space.PresenceSlot(2), 0);
  EXPECT_NE(space.Hash(), initial);
  space.SetAttribute(space.PresenceSlot(2), 1);
  EXPECT_EQ(space.Hash(), initial);

  space.FindEntity("fb2")->SetAttribute("led", 0xff0000, 11);
  EXPECT_NE(space.Hash(), initial);
}

TEST(Space, AReplicaFollowsByMessages)
{
  const Experiment experiment = TwoWorlds();
  CSwarmanoidSpace original(experiment);
  CSwarmanoidSpace replica(experiment);
  original.SetTick(7);
  original.SetPose(4, {{4, 4, 0}, QuaternionFromYaw(1)});
  original.FindEntity("fb0")->SetAttribute("beacon", 0x00ff00);

  SpaceState state;
  state.tick = 7;
  original.WritePoses(state.poses);
  state.attributes.Add(original.FindEntity("fb0")->SlotOf("beacon"), 0x00ff00);
  replica.Apply(state);
  EXPECT_EQ(replica.Hash(), original.Hash());
}

TEST(Space, WhatAMessageBringsIsFoundAtOnce)
{
  const Experiment experiment = TwoWorlds();
  CSwarmanoidSpace original(experiment);
  CSwarmanoidSpace replica(experiment);
  SpaceQuery query(replica);
  EXPECT_THAT(query.FindWithin(Vector3(8, 8, 0), 1), testing::ElementsAre());
  original.SetPose(4, {{8, 8, 0}, Quaternion::Identity()});
  SpaceState state;
  original.WritePoses(state.poses);
  replica.Apply(state);
  EXPECT_THAT(query.FindWithin(Vector3(8, 8, 0), 1), testing::ElementsAre(4));
  for (const std::uint32_t entity : replica.Movable())
    EXPECT_EQ(replica.GetPose(entity).position, original.GetPose(entity).position) << entity;
}

TEST(Space, AReplicaThatComesLateKnowsWhoIsNotThere)
{
  const Experiment experiment = TwoWorlds();
  CSwarmanoidSpace original(experiment);
  for (const std::uint32_t entity : {2U, 4U}) original.SetAttribute(original.PresenceSlot(entity), 0);
  original.SetPose(3, {{7, 7, 0}, Quaternion::Identity()});
  SpaceSnapshot snapshot;
  snapshot.tick = 9;
  original.SetTick(9);
  original.WritePoses(snapshot.poses);
  snapshot.attributes.assign(original.Attributes().Values().begin(), original.Attributes().Values().end());
  CSwarmanoidSpace replica(experiment);
  SpaceQuery query(replica);
  replica.Apply(snapshot);
  EXPECT_THAT(replica.Absent(), testing::ElementsAre(2, 4));
  EXPECT_EQ(replica.Hash(), original.Hash());
  EXPECT_THAT(query.FindWithin(Vector3(3, 1, 0), 0.5), testing::ElementsAre());
  EXPECT_THAT(query.FindWithin(Vector3(7, 7, 0), 0.5), testing::ElementsAre(3));
}

TEST(Space, AttributesThatAKindLacksAreRefusedByName)
{
  const Experiment experiment = TwoWorlds();
  const CSwarmanoidSpace space(experiment);
  EXPECT_THROW(space.FindEntity("prey")->GetAttribute("led"), std::out_of_range);
}

TEST(SpaceQuery, FindsNeighboursWithoutTheOneThatAsks)
{
  const Experiment experiment = TwoWorlds();
  CSwarmanoidSpace space(experiment);
  SpaceQuery query(space);
  EXPECT_THAT(query.FindWithin(*space.FindEntity("fb0"), 1.1), testing::ElementsAre(1, 3));
  EXPECT_EQ(query.FindNearest(*space.FindEntity("prey"), 5), space.FindEntity("fb2"));
  // The index follows the space.
  space.SetPose(3, {{9, 9, 0}, Quaternion::Identity()});
  EXPECT_THAT(query.FindWithin(*space.FindEntity("fb0"), 1.1), testing::ElementsAre(1));
}

TEST(SpaceQuery, WallsAndRobotsOcclude)
{
  const Experiment experiment = TwoWorlds();
  const CSwarmanoidSpace space(experiment);
  SpaceQuery query(space);
  EXPECT_TRUE(query.IsOccluded({1, 1, 0.1}, {3, 1, 0.1}, 0, 2));    // the wall is between
  EXPECT_FALSE(query.IsOccluded({1, 1, 0.6}, {3, 1, 0.6}, 0, 2));   // over the wall
  EXPECT_TRUE(query.IsOccluded({1, 1, 0.05}, {1, 3, 0.05}, 0, 4));  // another robot is between
  EXPECT_FALSE(query.IsOccluded({1, 1, 0.2}, {1, 3, 0.2}, 0, 4));   // over its head
}

TEST(SpaceQuery, WorldsThatAreClosedToEachOtherDoNotOcclude)
{
  const Experiment experiment = TwoWorlds();
  const CSwarmanoidSpace space(experiment);
  SpaceQuery query(space);
  EXPECT_FALSE(query.IsOccluded({1, 1, 0.1}, {3, 1, 0.1}, 5, 5));
  EXPECT_FALSE(query.FindFirstHit({1, 1, 0.1}, {3, 1, 0.1}, 5).has_value());
}

// Cameras need this: an entity is also hidden by bodies of its own world.
TEST(SpaceQuery, TheWorldOfTheOneThatIsLookedAtHidesIt)
{
  Experiment experiment = TwoWorlds();
  {
    const CSwarmanoidSpace space(experiment);
    SpaceQuery query(space);
    EXPECT_TRUE(query.IsOccluded({1, 1, 0.1}, {3, 1, 0.1}, 5, 2));
    EXPECT_TRUE(query.IsOccluded({3, 1, 0.1}, {1, 1, 0.1}, 2, 5));
  }
  // So does a wall that is in no engine.
  std::erase(experiment.engines[0].entities, 1U);
  const CSwarmanoidSpace space(experiment);
  SpaceQuery query(space);
  EXPECT_TRUE(query.IsOccluded({1, 1, 0.1}, {3, 1, 0.1}, 5, 5));
}

TEST(SpaceQuery, AWideBodyIsMetAtItsEdgeWhereverItStandsInTheFile)
{
  for (const std::uint32_t place : {0U, 3U, 4U})
  {
    Experiment experiment = TwoWorlds();
    experiment.entities[place] = Entity(EntityKind::kCylindricPrey, "wide", {5, 8, 0}, {0.5, 0.5, 0.2}, true);
    const CSwarmanoidSpace space(experiment);
    SpaceQuery query(space);
    const auto hit = query.FindFirstHit({3, 8.45, 0.1}, {7, 8.45, 0.1}, 2, {});
    ASSERT_TRUE(hit.has_value()) << place;
    EXPECT_EQ(hit->entity, place);
    EXPECT_NEAR(hit->fraction, (2 - std::sqrt(0.25 - 0.2025)) / 4, 1e-12);
  }
}

TEST(SpaceQuery, FirstHitGivesTheExactPlace)
{
  const Experiment experiment = TwoWorlds();
  const CSwarmanoidSpace space(experiment);
  SpaceQuery query(space);
  const std::array<std::uint32_t, 1> self{0};
  const auto hit = query.FindFirstHit({1, 1, 0.1}, {3, 1, 0.1}, 0, self);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->entity, 1U);
  EXPECT_NEAR(hit->fraction, (1.95 - 1) / 2, 1e-12);
}

TEST(SegmentHit, TurnedBoxesAndLyingCylindersAreExact)
{
  const Shape box{Shape::Kind::kBox, Vector3::Zero(), {1, 1, 1}};
  const Pose turned{{0, 0, 0}, QuaternionFromYaw(kPi / 4)};
  const auto corner = SegmentHit(box, turned, {-3, 0, 0}, {3, 0, 0});
  ASSERT_TRUE(corner);
  EXPECT_NEAR(-3 + 6 * *corner, -std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(SegmentHit(box, turned, {-3, 1.5, 0}, {3, 1.5, 0}));

  const Shape cylinder{Shape::Kind::kCylinder, Vector3::Zero(), {0.5, 0.5, 2}};
  const Pose lying{{0, 0, 0}, QuaternionFromEuler({kPi / 2, 0, 0})};  // its axis along y
  const auto cap = SegmentHit(cylinder, lying, {0, -5, 0.3}, {0, 5, 0.3});
  ASSERT_TRUE(cap);
  EXPECT_NEAR(-5 + 10 * *cap, -2, 1e-12);
  EXPECT_FALSE(SegmentHit(cylinder, lying, {0, -5, 0.6}, {0, 5, 0.6}));
  EXPECT_EQ(SegmentHit(cylinder, lying, {0, 0, 0}, {0, 9, 0}), 0.0);
}

}  // namespace
}  // namespace swarmanoid
