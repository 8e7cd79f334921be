#include "space_server/near_entities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

// Footbots in a row, a metre apart.
Experiment Row(std::uint32_t robots)
{
  Experiment experiment;
  experiment.arena_size = {100, 10, 2};
  for (std::uint32_t k = 0; k < robots; ++k)
  {
    EntityConfiguration& entity = experiment.entities.emplace_back();
    entity.kind = EntityKind::kFootbot;
    entity.id = "fb_" + std::to_string(k);
    entity.movable = true;
    entity.pose.position = {static_cast<double>(k), 5, 0};
  }
  return experiment;
}

class SurroundingsTest : public testing::Test
{
protected:
  static constexpr std::uint32_t kRobots = 40;

  LocalState& Part(std::vector<std::uint32_t> moved = {})
  {
    SpaceState state;
    state.tick = tick_++;
    state.moved = std::move(moved);
    for (const std::uint32_t slot : changed_) state.attributes.Add(slot, space_.Attributes()[slot]);
    changed_.clear();
    return surroundings_.Part(state);
  }
  void Change(std::uint32_t entity, const std::string& attribute, double value)
  {
    changed_.push_back(space_.GetEntity(entity).SlotOf(attribute));
    space_.SetAttribute(changed_.back(), value);
  }
  void Put(std::uint32_t entity, double x)
  {
    Pose pose = space_.GetPose(entity);
    pose.position.x() = x;
    space_.SetPose(entity, pose);
  }

  const Experiment experiment_ = Row(kRobots);
  CSwarmanoidSpace space_{experiment_};
  const std::vector<std::uint32_t> robots_{0, 1};
  Surroundings surroundings_{space_, robots_, 1.5};  // cells of 2.01 m
  std::uint64_t tick_ = 0;
  std::vector<std::uint32_t> changed_;
};

std::vector<std::size_t> NearOf(const LocalState& part)
{
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < 32 * part.near.size(); ++k)
    if (IsNear(part.near, k)) near.push_back(k);
  return near;
}

TEST_F(SurroundingsTest, HaveThoseWithinReachWithTheirPoses)
{
  const LocalState& part = Part();
  EXPECT_THAT(NearOf(part), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(part.entities, ElementsAre(0, 1, 2, 3, 4));
  ASSERT_EQ(part.poses.size(), 7 * 5U);
  EXPECT_EQ(part.poses[3], 3);
  EXPECT_EQ(part.poses[5 + 3], 5);
  EXPECT_THAT(part.attributes.slots, IsEmpty());
}

TEST_F(SurroundingsTest, TellThePosesOfThoseWhoMoved)
{
  Part();
  Put(2, 2.01);
  Put(30, 30.01);
  space_.SetPose(4, {space_.GetPose(4).position, {0.8, 0, 0, 0.6}});
  const LocalState& part = Part();
  EXPECT_THAT(part.entities, ElementsAre(2, 4));
  EXPECT_THAT(NearOf(part), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(Part().entities, IsEmpty());
}

TEST_F(SurroundingsTest, HaveTheAttributesOfThoseAlone)
{
  Part();
  Change(2, "beacon", 0xff);
  Change(30, "beacon", 0xff00);
  EXPECT_THAT(Part().attributes.slots, ElementsAre(space_.GetEntity(2).SlotOf("beacon")));
}

// Its changes in earlier ticks were not sent.
TEST_F(SurroundingsTest, TellAllAttributesOfWhoComesIn)
{
  Part();
  Change(30, "beacon", 0xff00);
  Part();
  Put(30, 2.5);
  const LocalState& part = Part();
  EXPECT_THAT(NearOf(part), ElementsAre(0, 1, 2, 3, 4, 30));
  EXPECT_THAT(part.entities, ElementsAre(30));
  const std::uint32_t first = space_.GetEntity(30).FirstSlot();
  ASSERT_EQ(part.attributes.slots.size(), space_.GetEntity(31).FirstSlot() - first + 1);
  EXPECT_EQ(part.attributes.slots.front(), first);
  EXPECT_EQ(part.attributes.slots.back(), space_.PresenceSlot(30));
  const std::uint32_t beacon = space_.GetEntity(30).SlotOf("beacon");
  EXPECT_EQ(part.attributes.values[beacon - first], 0xff00);
}

// The receiver may be another process than the one that got the last message.
TEST_F(SurroundingsTest, TellThePoseOfWhoComesInAgainAtTheSamePlace)
{
  Put(30, 2.5);
  Part();
  Put(30, 20);
  EXPECT_THAT(NearOf(Part()), ElementsAre(0, 1, 2, 3, 4));
  Put(30, 2.5);
  EXPECT_THAT(Part().entities, ElementsAre(30));
}

TEST_F(SurroundingsTest, SearchAgainOnceSomebodyHasLeftTheMargin)
{
  Part();
  Put(5, 4.8);  // out of reach, even if the search includes it
  Part();
  Put(5, 3.9);
  EXPECT_THAT(NearOf(Part()), ElementsAre(0, 1, 2, 3, 4, 5));
}

// They may be tilted in a plane for that tick, and see farther.
TEST_F(SurroundingsTest, AreAllWhenSomebodyIsPutElsewhere)
{
  Part();
  EXPECT_EQ(NearOf(Part({30})).size(), kRobots);
  EXPECT_THAT(NearOf(Part()), ElementsAre(0, 1, 2, 3, 4));
}

TEST_F(SurroundingsTest, MakeAReplicaInWhichOthersAreNotThere)
{
  CSwarmanoidSpace replica(experiment_);
  std::vector<std::uint32_t> near;
  replica.Apply(Part(), near);
  EXPECT_TRUE(replica.IsPresent(4));
  EXPECT_FALSE(replica.IsPresent(5));
  Put(30, 2.5);
  Change(30, "beacon", 7);
  replica.Apply(Part(), near);
  EXPECT_TRUE(replica.IsPresent(30));
  EXPECT_EQ(replica.GetPose(30).position.x(), 2.5);
  EXPECT_EQ(replica.Attributes()[replica.GetEntity(30).SlotOf("beacon")], 7);
  Put(30, 20);
  replica.Apply(Part(), near);
  EXPECT_FALSE(replica.IsPresent(30));
}

// The hold ended while it was not sent. The replica must not later have two entities hold each other.
TEST_F(SurroundingsTest, WhoIsNotToldHoldsNobody)
{
  CSwarmanoidSpace replica(experiment_);
  std::vector<std::uint32_t> near;
  const auto hold = [&](std::uint32_t gripper, std::uint32_t gripped)
  {
    changed_.push_back(space_.FirstHandSlot(gripper));
    space_.SetAttribute(changed_.back(), gripped);
  };
  Put(30, 2.5);
  hold(30, 1 + 2);
  replica.Apply(Part(), near);
  EXPECT_EQ(replica.Hands(30)[0], 3);
  Put(30, 20);
  hold(30, 0);
  replica.Apply(Part(), near);
  EXPECT_EQ(replica.Hands(30)[0], 0);
  Put(30, 2.5);
  hold(2, 1 + 30);
  replica.Apply(Part(), near);
  EXPECT_EQ(replica.Hands(2)[0], 31);
  EXPECT_EQ(replica.Hands(30)[0], 0);
}

// An engine does not need the poses that it computed, unless they were changed from outside.
TEST_F(SurroundingsTest, AnEngineIsToldOfOthersAndOfWhoWasMoved)
{
  std::vector<std::uint32_t> owned;
  for (std::uint32_t k = 3; k < kRobots; ++k) owned.push_back(k);
  EngineNews news(space_, owned);
  SpaceState state;
  state.attributes.Add(7, 0.5);
  EXPECT_THAT(news.Part(state).entities, ElementsAre(0, 1, 2));
  Put(1, 1.01);
  Put(9, 20);
  state.tick = 1;
  state.moved = {1, 9};
  const LocalState& part = news.Part(state);
  EXPECT_EQ(part.tick, 1U);
  EXPECT_THAT(part.entities, ElementsAre(1, 9));
  EXPECT_THAT(part.moved, ElementsAre(1, 9));
  EXPECT_EQ(part.poses[1], 20);
  EXPECT_EQ(part.poses.size(), 7 * 2U);
  EXPECT_THAT(part.near, IsEmpty());
  EXPECT_THAT(part.attributes.slots, ElementsAre(7));
}

}  // namespace
}  // namespace swarmanoid
