// Motions that stay under a plane do not bring outlines together, whatever parts of them are done.
#include "engine_worker/engines/kinematics2d/separating_planes.h"

#include <gtest/gtest.h>

#include <array>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kAllowed = 0.0005;

struct Mover
{
  CollisionModel model;
  Placed start;
  double way_x, way_y, turn;

  // Returns the body after parts of its way and of its turn.
  Placed After(double part_of_way, double part_of_turn) const
  {
    const SinCos turned = SinCosOf(part_of_turn * turn);
    Placed at = start;
    at.model = &model;
    at.x += part_of_way * way_x;
    at.y += part_of_way * way_y;
    at.cos = start.cos * turned.cos - start.sin * turned.sin;
    at.sin = start.sin * turned.cos + start.cos * turned.sin;
    return at;
  }
  MovingPart Part(std::uint32_t leader) const
  {
    MovingPart part = PartAt(After(0, 0), 0);
    part.can_move = true;
    part.leader = leader;
    part.way_x = way_x;
    part.way_y = way_y;
    part.turn = turn;
    part.centre_way_x = -turn * (part.centre_y - start.y);
    part.centre_way_y = turn * (part.centre_x - start.x);
    return part;
  }
};

Mover AnyMover(RandomStream& random, double x)
{
  Mover mover;
  const double size = random.Uniform(0.02, 0.2);
  mover.model = random.Uniform(0, 1) < 0.5 ? CircleModel(size) : RectangleModel(2 * size, random.Uniform(0.02, 0.2));
  const SinCos heading = SinCosOf(random.Uniform(-kPi, kPi));
  mover.start = {.x = x, .y = random.Uniform(-0.1, 0.1), .cos = heading.cos, .sin = heading.sin};
  mover.way_x = random.Uniform(-0.1, 0.1);
  mover.way_y = random.Uniform(-0.1, 0.1);
  mover.turn = random.Uniform(-1, 1);
  return mover;
}

// The deepest touch of two movers where they begin, at any distance.
Touch NearestOf(const Placed& a, const Placed& b)
{
  PairBatch batch;
  batch.Add(a, b);
  std::array<double, kDoubleLanes> margins;
  margins.fill(10);
  batch.FindAllTouches(margins);
  Touch touch{};
  batch.ForEachTouch([&](std::size_t, const Touch& found) { touch = found; });
  return touch;
}

TEST(SeparatingPlanes, KeepApartWhateverPartsOfTheMotionsAreDone)
{
  RandomStream random(1, 0, 0, 0);
  int limiting = 0;
  for (int scene = 0; scene < 3000; ++scene)
  {
    const Mover first = AnyMover(random, 0);
    const Mover second = AnyMover(random, random.Uniform(0.1, 0.5));
    const Placed a = first.After(0, 0);
    const Placed b = second.After(0, 0);
    if (Overlap(a, b) > kAllowed) continue;
    const SeparatingPlane plane = PlaneBetween(first.Part(0), second.Part(1), NearestOf(a, b), kAllowed);
    ASSERT_GE(plane.gap, -1e-12);
    limiting += plane.left < 0 ? 1 : 0;
    for (int sample = 0; sample < 20; ++sample)
    {
      std::array<double, 4> parts;
      double nearer = 0;
      for (int k = 0; k < 4; ++k)
      {
        parts[k] = random.Uniform(0, 1);
        nearer += parts[k] * plane.approaches[k].rate;
      }
      // Shorter motions are under the plane, if these are not.
      const double scale = nearer > plane.gap ? std::max(plane.gap, 0.0) / nearer : 1;
      for (double& part : parts) part *= scale;
      EXPECT_LE(Overlap(first.After(parts[0], parts[1]), second.After(parts[2], parts[3])), kAllowed + 1e-12)
          << "scene " << scene;
    }
  }
  EXPECT_GT(limiting, 100);
}

TEST(SeparatingPlanes, APlaneNamesTheMotionsOfBothLeadersAndNothingForAWall)
{
  const CollisionModel disc = CircleModel(0.1);
  const CollisionModel box = RectangleModel(0.2, 0.2);
  MovingPart mover = PartAt({.x = 0.3, .model = &disc}, 0);
  mover.can_move = true;
  mover.leader = 7;
  mover.way_x = -0.2;
  const MovingPart wall = PartAt({.model = &box}, 0);
  const Placed at{.x = 0.3, .model = &disc};
  const SeparatingPlane plane = PlaneBetween(mover, wall, NearestOf(at, {.model = &box}), 0);
  EXPECT_NEAR(plane.gap, 0.1, 1e-12);
  EXPECT_NEAR(plane.left, -0.1, 1e-12);
  EXPECT_EQ(plane.approaches[0].motion, WayMotion(7));
  EXPECT_NEAR(plane.approaches[0].rate, 0.2, 1e-12);
  EXPECT_EQ(plane.approaches[2].rate, 0);
  EXPECT_EQ(plane.approaches[3].rate, 0);
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
