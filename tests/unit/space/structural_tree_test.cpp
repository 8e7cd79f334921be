#include "common/space/structural_tree.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "common/math/elementary.h"
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

// Six footbots (0 … 5), a handbot (6), two preys (7, 8), a shelf that is fixed (9).
Experiment RobotsAndPreys()
{
  Experiment experiment;
  experiment.arena_size = {10, 10, 3};
  for (int i = 0; i < 10; ++i)
  {
    const EntityKind kind = i < 6   ? EntityKind::kFootbot
                            : i < 7 ? EntityKind::kHandbot
                            : i < 9 ? EntityKind::kCylindricPrey
                                    : EntityKind::kBlock;
    experiment.entities.push_back(test::Entity(kind, "e" + std::to_string(i), {1 + 0.3 * i, 2 - 0.2 * i, 0}, 0.7 * i));
  }
  return experiment;
}

class Structure : public testing::Test
{
protected:
  void Hold(std::uint32_t gripper, int held, int hand = 0)
  {
    space.SetAttribute(space.GetEntity(gripper).SlotOf("gripped", hand), held + 1);
  }
  std::vector<std::uint32_t> CompoundOf(std::uint32_t member) const
  {
    return space.Structure().GetCompound(member).GetMembers();
  }
  // Returns the error for an engine that moves all entities and reports these holds.
  std::string MistakeIn(const std::vector<std::pair<std::uint32_t, int>>& holds)
  {
    AttributeChanges changes;
    for (const auto& [gripper, held] : holds) changes.Add(space.FirstHandSlot(gripper), held + 1);
    return MistakeIn(changes, space.Movable());
  }
  std::string MistakeIn(const AttributeChanges& changes, std::span<const std::uint32_t> owned)
  {
    return test::MessageOf<StateError>([&] { CheckHolds(space, owned, changes); });
  }

  const Experiment experiment = RobotsAndPreys();
  CSwarmanoidSpace space{experiment};
};

TEST_F(Structure, TheGrippedOneIsTheRootOfAllThatHoldIt)
{
  Hold(3, 7);
  Hold(0, 7);
  Hold(2, 0);
  EXPECT_EQ(space.Structure().GetRoot(2), 7U);
  EXPECT_THAT(space.Structure().GetHolders(7), ElementsAre(0, 3));
  EXPECT_THAT(CompoundOf(3), ElementsAre(0, 2, 3, 7));
  Hold(0, -1);
  EXPECT_THAT(CompoundOf(3), ElementsAre(3, 7));
  EXPECT_THAT(CompoundOf(0), ElementsAre(0, 2));
}

TEST_F(Structure, AHandOnAShelfHoldsOnToTheWorld)
{
  Hold(6, 9, 0);
  EXPECT_EQ(space.Structure().GetHeld(6), StructuralTree::kNothing);
  EXPECT_THAT(CompoundOf(6), ElementsAre(6));
  Hold(6, 8, 1);
  EXPECT_THAT(CompoundOf(6), ElementsAre(6, 8));
  EXPECT_THAT(CompoundOf(9), ElementsAre(9));
}

// Against what follows from the attributes alone, after each of many changes, in batches and one by one.
TEST_F(Structure, FollowsTheAttributesHoweverTheyChange)
{
  std::mt19937 random(1);
  for (int change = 0; change < 2000; ++change)
  {
    AttributeChanges changes;
    for (std::uint32_t gripper = 0; gripper < 6; ++gripper)
      // Only of higher numbers: so there are no loops.
      if (random() % 3 == 0)
        changes.Add(space.FirstHandSlot(gripper),
                    static_cast<double>(random() % 3 == 0 ? 0 : 1 + gripper + 1 + random() % (8 - gripper)));
    if (change % 2 == 0)
      space.SetAttributes(changes);
    else
      for (std::size_t k = 0; k < changes.slots.size(); ++k) space.SetAttribute(changes.slots[k], changes.values[k]);

    std::vector<std::uint32_t> roots(space.Size());
    for (std::uint32_t i = 0; i < space.Size(); ++i)
    {
      roots[i] = i;
      while (roots[i] < 6 && space.GetEntity(roots[i]).GetAttribute("gripped") != 0)
        roots[i] = static_cast<std::uint32_t>(space.GetEntity(roots[i]).GetAttribute("gripped")) - 1;
    }
    for (std::uint32_t i = 0; i < space.Size(); ++i)
    {
      ASSERT_EQ(space.Structure().GetRoot(i), roots[i]);
      std::vector<std::uint32_t> members;
      for (std::uint32_t k = 0; k < space.Size(); ++k)
        if (roots[k] == roots[i]) members.push_back(k);
      ASSERT_EQ(CompoundOf(i), members);
    }
  }
}

TEST_F(Structure, AReplicaThatJoinsLateHasTheSameTree)
{
  Hold(1, 2);
  Hold(2, 8);
  SpaceSnapshot snapshot;
  space.WritePoses(snapshot.poses);
  snapshot.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
  CSwarmanoidSpace replica(experiment);
  replica.Apply(snapshot);
  EXPECT_THAT(replica.Structure().GetCompound(8).GetMembers(), ElementsAre(1, 2, 8));
}

TEST_F(Structure, ACompoundMovesAsOneRigidBodyAndTheOneThatIsPutSomewhereIsThereToTheLastBit)
{
  Hold(0, 7);
  Hold(3, 7);
  const auto seen_from_prey = [&](std::uint32_t i) { return space.GetPose(7).Inverse().Compose(space.GetPose(i)); };
  const Pose before0 = seen_from_prey(0);
  const Pose before3 = seen_from_prey(3);
  const CCompoundEntity compound = space.Structure().GetCompound(0);
  const Pose there{{7, 6, 0}, QuaternionFromYaw(2)};
  const std::vector<Pose> poses = compound.PosesAt(3, there);
  for (std::size_t k = 0; k < poses.size(); ++k) space.SetPose(compound.GetMembers()[k], poses[k]);
  EXPECT_EQ(space.GetEntity(3).GetPosition(), there.position);
  EXPECT_EQ(space.GetEntity(3).GetOrientation().coeffs(), there.orientation.coeffs());
  EXPECT_TRUE(seen_from_prey(0).position.isApprox(before0.position, 1e-14));
  EXPECT_TRUE(seen_from_prey(3).position.isApprox(before3.position, 1e-14));
  EXPECT_NEAR(std::abs(seen_from_prey(3).orientation.dot(before3.orientation)), 1, 1e-14);
}

TEST_F(Structure, ImpossibleHoldsAreRefusedWithTheReason)
{
  EXPECT_EQ(MistakeIn({{0, 0}}), "'e0' cannot grip 'e0': an entity cannot grip itself");
  EXPECT_EQ(MistakeIn({{0, 1}}), "");
  EXPECT_EQ(MistakeIn({{0, 1}, {1, 2}, {2, 0}}), "'e0' cannot grip 'e1': the connection would close a loop");
  EXPECT_EQ(MistakeIn({{0, 9}}), "");  // the world
  Hold(0, 1);
  Hold(1, 2);
  EXPECT_EQ(MistakeIn({{2, 0}}), "'e2' cannot grip 'e0': the connection would close a loop");
  // In one tick the one lets go and the other takes hold.
  EXPECT_EQ(MistakeIn({{1, -1}, {2, 0}}), "");
  AttributeChanges both_hands;
  both_hands.Add(space.FirstHandSlot(6), 1 + 7);
  both_hands.Add(space.FirstHandSlot(6) + 1, 1 + 8);
  EXPECT_EQ(MistakeIn(both_hands, space.Movable()),
            "the handbot 'e6' would hold 'e7' and 'e8': a robot holds one thing at a time");
  both_hands.values[1] = 1 + 7;
  EXPECT_EQ(MistakeIn(both_hands, space.Movable()), "");
  const std::vector<std::uint32_t> owned{6};
  EXPECT_EQ(MistakeIn(both_hands, owned),
            "the handbot 'e6' would hold 'e7', but the engine does not move the cylindric_prey 'e7'");
}

TEST_F(Structure, ASavedLoopIsRefused)
{
  SpaceSnapshot snapshot;
  space.WritePoses(snapshot.poses);
  snapshot.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
  snapshot.attributes[space.FirstHandSlot(4)] = 1 + 5;
  EXPECT_NO_THROW(CheckSnapshot(space, snapshot));
  snapshot.attributes[space.FirstHandSlot(5)] = 1 + 4;
  EXPECT_THROW(CheckSnapshot(space, snapshot), StateError);
}

}  // namespace
}  // namespace swarmanoid
