// The listings of behaviours and of state machines do what their text describes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/space/attributes.h"
#include "seed_experiment.h"
#include "tests/results/held_hash.h"

namespace swarmanoid::test
{
namespace
{

constexpr double kFootbotRadius = 0.085036758;

Vector3 PlaceOf(const CSwarmanoidSpace& space) { return space.FindEntity("fb")->GetPosition(); }

TEST(SeedBehaviors, ABehaviorReadsTheSensorsAndSetsTheWheels)
{
  // The printed listing sets both wheels to nothing.
  RunSeedExperiment({.controller = "behavior"},
                    [](const CSwarmanoidSpace& space) { EXPECT_EQ(PlaceOf(space), Vector3(1, 1, 0)); });
  // With its logic it goes up to the wall, whose face is at x = 1.9, and stays off.
  double farthest = 0;
  RunSeedExperiment({.controller = "behavior_filled"},
                    [&](const CSwarmanoidSpace& space) { farthest = std::max(farthest, PlaceOf(space).x()); });
  EXPECT_GT(farthest, 1.9 - kFootbotRadius - 0.1);
  EXPECT_LT(farthest, 1.9 - kFootbotRadius);
}

TEST(SeedBehaviors, TheSecondOfTwoInSequenceHasPriority)
{
  const SeedExperiment closed{.controller = "sequential", .arena_m = 1.2, .start = "0.6, 0.6, 0"};
  const std::uint64_t hash = RunSeedExperiment(closed);
  // It is the same as the ready-made combination in the listing of the controller.
  SeedExperiment other = closed;
  other.controller = "new_controller";
  EXPECT_EQ(RunSeedExperiment(other), hash);
  other.controller = "random_walk";
  EXPECT_NE(RunSeedExperiment(other), hash);

  // Far from everything, the second one decides nothing, and the first one's wish stays.
  SeedExperiment open{.controller = "sequential", .arena_m = 20, .walled = false, .start = "10, 10, 0"};
  const std::uint64_t free = RunSeedExperiment(open);
  open.controller = "random_walk";
  EXPECT_EQ(RunSeedExperiment(open), free);
}

TEST(SeedBehaviors, WhatIsSetOnACopyNeedsAMergeToReachTheRobot)
{
  RunSeedExperiment({.controller = "parallel"},
                    [](const CSwarmanoidSpace& space) { EXPECT_EQ(PlaceOf(space), Vector3(1, 1, 0)); });

  SeedExperiment open{.controller = "parallel_filled", .arena_m = 20, .walled = false, .start = "10, 10, 0"};
  const std::uint64_t free = RunSeedExperiment(open);
  open.controller = "random_walk";
  EXPECT_EQ(RunSeedExperiment(open), free);

  // Near a wall both wishes count, so it is neither of them.
  SeedExperiment closed{.controller = "parallel_filled", .arena_m = 1.2, .start = "0.6, 0.6, 0"};
  const std::uint64_t merged = RunSeedExperiment(closed);
  closed.controller = "sequential";
  EXPECT_NE(RunSeedExperiment(closed), merged);
  closed.controller = "random_walk";
  EXPECT_NE(RunSeedExperiment(closed), merged);
}

TEST(SeedBehaviors, AControllerOfBehaviorsWandersAndKeepsOffTheWalls)
{
  Vector3 low = Vector3::Constant(10);
  Vector3 high = Vector3::Constant(-10);
  const std::uint64_t hash = RunSeedExperiment({.controller = "new_controller", .ticks = 3000},
                                               [&](const CSwarmanoidSpace& space)
                                               {
                                                 low = low.cwiseMin(PlaceOf(space));
                                                 high = high.cwiseMax(PlaceOf(space));
                                               });
  EXPECT_EQ(hash, HeldHash("seed_wandering_behaviors")) << fmt::format("{:016x}", hash);
  for (int axis = 0; axis < 2; ++axis)
  {
    EXPECT_GT(high[axis] - low[axis], 1) << "axis " << axis;
    EXPECT_GT(low[axis], 0.1 + kFootbotRadius);
    EXPECT_LT(high[axis], 1.9 - kFootbotRadius);
  }
}

// The state that the robot shows at each tick: 1, 2, 3 for STATE_ONE, TWO, THREE.
std::vector<int> StatesOf(const char* controller)
{
  std::vector<int> states;
  RunSeedExperiment({.controller = controller, .ticks = 14},
                    [&](const CSwarmanoidSpace& space)
                    {
                      const CSwarmanoidSpaceEntity& robot = *space.FindEntity("fb");
                      if (space.GetTick() > 0) states.push_back(static_cast<int>(robot.GetAttribute("led")));
                    });
  return states;
}

TEST(SeedFsm, StaysInItsStartStateWithoutInputs) { EXPECT_EQ(StatesOf("machine"), std::vector<int>(14, 1)); }

TEST(SeedFsm, InputsTakeTheTransitions)
{
  // State one goes to two at tick 3, two to three at 6, and three back to two at 9.
  EXPECT_EQ(StatesOf("machine_filled"), (std::vector<int>{1, 1, 1, 2, 2, 2, 3, 3, 3, 2, 2, 2, 2, 2}));
}

}  // namespace
}  // namespace swarmanoid::test
