// Tests which entities block the position of an added entity.
#include "space_server/space_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "common/experiment/body.h"
#include "common/math/elementary.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

class InTheWay : public ::testing::Test
{
protected:
  InTheWay() { experiment_.arena_size = {10, 10, 3}; }

  // Engines by number; an entity may be in any number of them.
  std::uint32_t Add(EntityKind kind, const std::string& id, const Pose& pose, std::vector<std::size_t> engines,
                    const Vector3& size = Vector3::Zero())
  {
    const auto index = static_cast<std::uint32_t>(experiment_.entities.size());
    EntityConfiguration& entity = experiment_.entities.emplace_back();
    entity.kind = kind;
    entity.id = id;
    entity.pose = pose;
    entity.movable = true;
    entity.size = IsRobot(kind) ? DescriptionOf(kind).size : size;
    experiment_.engines.resize(2);
    for (const std::size_t engine : engines) experiment_.engines[engine].entities.push_back(index);
    return index;
  }
  // Returns the id of the blocking entity, or "".
  std::string At(const std::string& id, const Vector3& place, double yaw = 0)
  {
    const CSwarmanoidSpace space(experiment_);
    const CSwarmanoidSpaceEntity* other = FindInTheWay(space, *space.FindEntity(id), {place, QuaternionFromYaw(yaw)});
    return other == nullptr ? "" : other->GetId();
  }
  void AddWaiting(EntityKind kind, const std::string& id, std::vector<std::size_t> engines,
                  const Vector3& size = Vector3::Zero())
  {
    const std::uint32_t index = Add(kind, id, {}, std::move(engines), size);
    experiment_.entities[index].pose = WaitingPose(experiment_.entities[index], index);
    experiment_.entities[index].waits = true;
  }

  Experiment experiment_;
};

TEST_F(InTheWay, EnginesAreClosedWorlds)
{
  Add(EntityKind::kFootbot, "ground", {{2, 2, 0}, Quaternion::Identity()}, {0});
  Add(EntityKind::kFootbot, "nowhere", {{3, 3, 0}, Quaternion::Identity()}, {});
  Add(EntityKind::kFootbot, "both", {{4, 4, 0}, Quaternion::Identity()}, {0, 1});
  AddWaiting(EntityKind::kFootbot, "late_ground", {0});
  AddWaiting(EntityKind::kFootbot, "late_sky", {1});
  AddWaiting(EntityKind::kFootbot, "late_ghost", {});
  EXPECT_EQ(At("late_ground", {2.1, 2, 0}), "ground");
  EXPECT_EQ(At("late_sky", {2.1, 2, 0}), "");
  EXPECT_EQ(At("late_ground", {3, 3, 0}), "");
  EXPECT_EQ(At("late_sky", {4, 4, 0}), "both");
  EXPECT_EQ(At("late_ghost", {4, 4, 0}), "");
}

TEST_F(InTheWay, PlacesThatAreAskedForAreInMetresAndDegrees)
{
  Add(EntityKind::kEyebot, "eb", {{2, 2, 1}, QuaternionFromYaw(0.5)}, {0});
  const CSwarmanoidSpace space(experiment_);
  const auto asked_for = [&](const std::vector<double>& numbers) {
    return ReadMove({"move", {{"entity", "eb"}, {"pose", numbers}}}, space).moves.at(0).pose;
  };
  EXPECT_EQ(asked_for({3, 4, 1.5}).position, Vector3(3, 4, 1.5));
  EXPECT_NEAR(YawOf(asked_for({3, 4, 1.5}).orientation), 0.5, 1e-12) << "it keeps its heading";
  const Quaternion wanted = QuaternionFromEuler({DegreesToRadians(10), DegreesToRadians(20), -kPi / 2});
  EXPECT_LT(asked_for({3, 4, 1.5, 10, 20, -90}).orientation.angularDistance(wanted), 1e-12);
}

TEST_F(InTheWay, NobodyWhoWaitsAndNothingWithoutABody)
{
  AddWaiting(EntityKind::kFootbot, "a", {0});
  AddWaiting(EntityKind::kFootbot, "b", {0});
  Add(EntityKind::kGroundPatch, "mat", {{2, 2, 0}, Quaternion::Identity()}, {}, {1, 1, 0});
  AddWaiting(EntityKind::kLightBulb, "lamp", {});
  Add(EntityKind::kFootbot, "fb", {{5, 5, 0}, Quaternion::Identity()}, {0});
  EXPECT_EQ(At("a", {2, 2, 0}), "");
  EXPECT_EQ(At("lamp", {5, 5, 0}), "");
  // Where it would be beside the other one, outside all arenas.
  EXPECT_EQ(At("a", WaitingPose(experiment_.entities[1], 1).position), "");
}

// There are a plank of 2 m x 0.1 m and a prey of 0.1 m: along the plank the place is taken, beside it is free, and
// turned the other way.
TEST_F(InTheWay, BodiesCountWithTheirShapeHeightAndHeading)
{
  Add(EntityKind::kCylindricPrey, "prey", {{5, 5.8, 0}, Quaternion::Identity()}, {0}, {0.1, 0.1, 0.2});
  AddWaiting(EntityKind::kBlock, "plank", {0}, {2, 0.1, 0.1});
  EXPECT_EQ(At("plank", {5, 5, 0.05}), "");
  EXPECT_EQ(At("plank", {5, 5, 0.05}, kPi / 2), "prey");
  EXPECT_EQ(At("plank", {5.141, 5, 0.05}, kPi / 2), "prey");
  EXPECT_EQ(At("plank", {5.151, 5, 0.05}, kPi / 2), "");
  EXPECT_EQ(At("plank", {5, 5, 0.249}, kPi / 2), "prey");
  EXPECT_EQ(At("plank", {5, 5, 0.251}, kPi / 2), "");
}

// fb holds the prey, 0.2 m before it; a wall, and another one.
class MovedTogether : public InTheWay
{
protected:
  MovedTogether()
  {
    Add(EntityKind::kFootbot, "fb", {{2, 2, 0}, Quaternion::Identity()}, {0});
    Add(EntityKind::kCylindricPrey, "prey", {{2.2, 2, 0}, Quaternion::Identity()}, {0}, {0.1, 0.1, 0.1});
    Add(EntityKind::kBlock, "wall", {{5, 5, 0.1}, Quaternion::Identity()}, {0}, {0.1, 0.1, 0.2});
    experiment_.entities.back().movable = false;
    space.emplace(experiment_);
    space->SetAttribute(space->FindEntity("fb")->SlotOf("gripped"), 1 + 1);
  }
  SpaceChange Asked(const std::string& verb, const std::string& id, const std::vector<double>& numbers)
  {
    const ControlOrder order{verb, {{"entity", id}, {"pose", numbers}}};
    return verb == "move" ? ReadMove(order, *space) : ReadDetachment(order, *space);
  }
  std::string Mistake(const std::string& verb, const std::string& id, const std::vector<double>& numbers)
  {
    return test::MessageOf<std::invalid_argument>([&] { Asked(verb, id, numbers); });
  }
  std::optional<CSwarmanoidSpace> space;
};

TEST_F(MovedTogether, MoveTakesAllAlongAndDetachOne)
{
  const SpaceChange whole = Asked("move", "fb", {7, 7, 0, 0, 0, 90});
  ASSERT_EQ(whole.moves.size(), 2U);
  EXPECT_LT((whole.moves[1].pose.position - Vector3(7, 7.2, 0)).norm(), 1e-12);
  EXPECT_EQ(whole.done, "moved 'fb' and 1 that it is connected to");
  const SpaceChange one = Asked("detach", "fb", {7, 7, 0});
  ASSERT_EQ(one.moves.size(), 1U);
  EXPECT_EQ(one.moves[0].pose.position, Vector3(7, 7, 0));
}

TEST_F(MovedTogether, TheWholeIsRefusedWhereAnyOfThemDoesNotFit)
{
  EXPECT_EQ(Mistake("move", "fb", {2.15, 2, 0}), "") << "where the prey is now";
  EXPECT_THAT(Mistake("move", "fb", {4.8, 5, 0}),
              testing::HasSubstr("'prey' does not fit at 5, 5, 0: the block 'wall'"));
  EXPECT_EQ(Mistake("detach", "fb", {4.8, 5, 0}), "");
  EXPECT_THAT(Mistake("move", "prey", {5, 5, 0}), testing::HasSubstr("'prey' does not fit"));
  EXPECT_THAT(Mistake("move", "fb", {9.9, 5, 0}),
              testing::HasSubstr("'prey' would come to 10.1, 5, 0, outside the arena"));
  EXPECT_THAT(Mistake("detach", "fb", {2.15, 2, 0}), testing::HasSubstr("the cylindric_prey 'prey' stands there"));
}

}  // namespace
}  // namespace swarmanoid
