#include "common/space/state_checks.h"
#include "common/math/finite.h"
#include "common/space/space.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Readers cannot write: what a const space gives is const.
static_assert(
    std::is_same_v<decltype(std::declval<const CSwarmanoidSpace&>().GetEntity(0)), const CSwarmanoidSpaceEntity&>);
static_assert(
    std::is_same_v<decltype(std::declval<const CSwarmanoidSpace&>().FindEntity("")), const CSwarmanoidSpaceEntity*>);
static_assert(
    std::is_same_v<decltype(std::declval<const CFootBotEntity&>().GetGrippedEntity()), const CSwarmanoidSpaceEntity*>);

class StateChecks : public testing::Test
{
protected:
  static Experiment Robots()
  {
    Experiment experiment;
    experiment.arena_size = {10, 10, 2};
    experiment.limit_m = 100;
    for (int i = 0; i < 20; ++i)
    {
      const EntityKind kind = i == 7 ? EntityKind::kEyebot : i == 8 ? EntityKind::kHole : EntityKind::kFootbot;
      EntityConfiguration entity = test::Entity(kind, "e" + std::to_string(i), {0.5 * i, 1, 0});
      entity.waits = i == 19;
      if (entity.waits) entity.pose = WaitingPose(entity, 19);
      experiment.entities.push_back(entity);
    }
    return experiment;
  }

  template <class Check>
  static std::string Mistake(const Check& check)
  {
    return test::MessageOf<StateError>(check);
  }
  std::string MistakeOfPoses()
  {
    return Mistake(
        [this]
        {
          CheckPoses(space, space.Movable(), poses);
          CheckWithinLimit(space, space.Movable(), poses);
        });
  }
  std::string MistakeOf(const std::string& entity, const char* name, double value, int element = 0)
  {
    const std::uint32_t slot = space.FindEntity(entity)->SlotOf(name, element);
    return Mistake([&] { CheckAttribute(space, slot, value); });
  }

  const Experiment experiment = Robots();
  CSwarmanoidSpace space{experiment};
  std::vector<double> poses = [this]
  {
    std::vector<double> all;
    space.WritePoses(all);
    return all;
  }();
  const std::size_t count = space.Movable().size();
};

TEST_F(StateChecks, AnyNumberThatIsNotFiniteIsFoundWhereverItStands)
{
  EXPECT_EQ(MistakeOfPoses(), "");
  for (std::size_t k = 0; k < poses.size(); ++k)
    for (const double value : {kNan, -kNan, kInfinite, -kInfinite})
    {
      const double kept = std::exchange(poses[k], value);
      EXPECT_FALSE(AllFinite(poses));
      const std::string entity = space.GetEntity(space.Movable()[k % count]).GetId();
      EXPECT_THAT(MistakeOfPoses(), HasSubstr("'" + entity + "' has a pose with ")) << k;
      poses[k] = kept;
    }
  poses[3] = std::numeric_limits<double>::denorm_min();
  poses[4] = -0.0;
  EXPECT_EQ(MistakeOfPoses(), "");
}

TEST_F(StateChecks, OrientationsHaveNormOne)
{
  poses[6 * count + 2] = 0.999;
  EXPECT_THAT(MistakeOfPoses(), HasSubstr("the footbot 'e2' has an orientation of norm 0.999"));
  poses[6 * count + 2] = 1 + 1e-8;
  EXPECT_EQ(MistakeOfPoses(), "");
  poses[6 * count + 2] = 0;
  EXPECT_THAT(MistakeOfPoses(), HasSubstr("an orientation of norm 0 "));
  // Each of the four parts counts once: one of them alone must be 1 or -1.
  for (std::size_t part = 3; part < 7; ++part)
    for (const double value : {-1.0, std::sqrt(0.5)})
    {
      for (std::size_t k = 3 * count; k < 7 * count; ++k) poses[k] = k / count == part ? value : 0;
      const std::string mistake = MistakeOfPoses();
      EXPECT_EQ(mistake.find("has an orientation of norm 0.707") != std::string::npos, value > 0) << part << mistake;
    }
}

TEST_F(StateChecks, PosesMustBeAsManyAsThereAreEntities)
{
  poses.pop_back();
  EXPECT_EQ(MistakeOfPoses(), "there are 132 numbers for the poses of 19 entities; there must be 7 for each, 133");
}

TEST_F(StateChecks, TheLimitCountsOnAllSidesAndForThoseWhoAreThere)
{
  const auto beyond = [this] { return FindBeyondLimit(space, space.Movable(), poses); };
  EXPECT_TRUE(beyond().empty()) << "the one that waits does not count";
  poses[5] = -100;
  poses[6] = 110;
  EXPECT_TRUE(beyond().empty());
  poses[5] = -100.5;
  poses[6] = 110.5;
  poses[count + 2] = 1e300;
  poses[2 * count + 9] = -1e4;
  EXPECT_THAT(beyond(), ElementsAre(2, 5, 6, 9));
  EXPECT_THAT(MistakeOfPoses(), HasSubstr("the footbot 'e2' left the world: it is at 1, 1e+300, 0, more than 100 m"));
  space.SetAttribute(space.PresenceSlot(19), 1);
  EXPECT_THAT(beyond(), ElementsAre(2, 5, 6, 9, 18));
}

TEST_F(StateChecks, AttributesAreWhatTheirKindsAllow)
{
  EXPECT_EQ(MistakeOf("e0", "led", 0xffffff, 11), "");
  EXPECT_EQ(MistakeOf("e0", "gripped", 20), "");
  EXPECT_EQ(MistakeOf("e0", "message", 1099511627775, 2), "");
  EXPECT_EQ(MistakeOf("e7", "laser_tilt", -0.5), "");
  EXPECT_THAT(MistakeOf("e0", "led", 0x1000000, 11),
              HasSubstr("the attribute 'led' 11 of the footbot 'e0' is 16777216"));
  for (const double colour : {-1.0, 0.5, kNan, kInfinite}) EXPECT_NE(MistakeOf("e18", "beacon", colour), "") << colour;
  for (const double held : {-1.0, 21.0, 0.5, kNan}) EXPECT_NE(MistakeOf("e9", "gripped", held), "") << held;
  for (const double number : {kNan, kInfinite, 1e300}) EXPECT_NE(MistakeOf("e7", "laser_tilt", number), "") << number;
  EXPECT_THAT(MistakeOf("e7", "laser", 2),
              HasSubstr("the attribute 'laser' of the eyebot 'e7' is 2: it must be 0 or 1"));
}

TEST_F(StateChecks, SlotsAreThoseThatExist)
{
  const auto end = static_cast<std::uint32_t>(space.Attributes().size());
  EXPECT_THAT(Mistake([&] { CheckAttribute(space, end, 0); }), HasSubstr("there is no attribute slot"));
  EXPECT_THAT(Mistake([&] { CheckAttribute(space, space.PresenceSlot(3), 0); }),
              HasSubstr("the presence of the footbot 'e3' is 0"));
  AttributeChanges changes;
  changes.Add(0, 1);
  changes.values.clear();
  EXPECT_THAT(Mistake([&] { CheckAttributes(space, changes); }), HasSubstr("there are 0 values for 1 slots"));
  for (std::uint32_t entity = 0; entity < space.Size(); ++entity)
  {
    EXPECT_EQ(EntityOfSlot(space, space.PresenceSlot(entity)), entity);
    if (AttributeCount(space.GetEntity(entity).GetKind()) == 0) continue;
    EXPECT_EQ(EntityOfSlot(space, space.GetEntity(entity).FirstSlot()), entity);
  }
  const CSwarmanoidSpaceEntity& footbot = *std::as_const(space).FindEntity("e0");
  for (const int element : {-1, 12, 13, 100000000})
    EXPECT_THROW(footbot.GetAttribute("led", element), std::out_of_range);
}

TEST_F(StateChecks, ASavedStateIsCheckedAsAWhole)
{
  SpaceSnapshot snapshot;
  snapshot.poses = poses;
  snapshot.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
  const auto mistake = [&] { return Mistake([&] { CheckSnapshot(space, snapshot); }); };
  EXPECT_EQ(mistake(), "");
  std::swap(snapshot.attributes[space.PresenceSlot(1)], snapshot.attributes[space.PresenceSlot(19)]);
  EXPECT_EQ(mistake(), "");
  snapshot.attributes[space.PresenceSlot(1)] = 0.5;
  EXPECT_THAT(mistake(), HasSubstr("the presence of the footbot 'e1' is 0.5"));
  snapshot.attributes.pop_back();
  EXPECT_EQ(mistake(), "it has other entities");
}

TEST_F(StateChecks, ChannelsNameTheRobotAndTheChannel)
{
  const std::vector<ChannelBlock> blocks{{"propellers", 4, {7}, 0}, {"wheels", 2, {0, 2, 5}, 4}};
  std::vector<double> values(10);
  EXPECT_EQ(Mistake([&] { CheckChannels(space, blocks, values, "commands"); }), "");
  values[7] = kNan;
  EXPECT_EQ(Mistake([&] { CheckChannels(space, blocks, values, "commands"); }),
            "the commands of the footbot 'e2' on the channel 'wheels' hold nan; they must be finite");
}

TEST_F(StateChecks, PresenceIsPartOfTheStateBesideThePose)
{
  EXPECT_THAT(space.Absent(), ElementsAre(19));
  const std::uint64_t all = space.Hash();
  space.SetAttribute(space.PresenceSlot(3), 0);
  EXPECT_THAT(space.Absent(), ElementsAre(3, 19));
  EXPECT_FALSE(space.IsPresent(3));
  EXPECT_NE(space.Hash(), all);

  // The check does not depend on the position.
  space.SetPose(4, {{-9e4, 0, 0}, Quaternion::Identity()});
  EXPECT_TRUE(space.IsPresent(4));

  SpaceState state;
  space.WritePoses(state.poses);
  state.attributes.Add(space.PresenceSlot(3), 0);
  CSwarmanoidSpace replica(experiment);
  replica.Apply(state);
  EXPECT_THAT(replica.Absent(), ElementsAre(3, 19));
  EXPECT_EQ(replica.Hash(), space.Hash());

  SpaceSnapshot snapshot;
  snapshot.poses = state.poses;
  snapshot.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
  CSwarmanoidSpace late(experiment);
  late.Apply(snapshot);
  EXPECT_THAT(late.Absent(), ElementsAre(3, 19));
  EXPECT_EQ(late.Hash(), space.Hash());
}

}  // namespace
}  // namespace swarmanoid
