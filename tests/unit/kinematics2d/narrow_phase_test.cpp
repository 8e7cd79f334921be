#include "engine_worker/engines/kinematics2d/narrow_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

Placed Put(const CollisionModel& model, double x, double y, double heading, double turret = 0)
{
  return {x, y, Cos(heading), Sin(heading), Cos(turret), Sin(turret), &model};
}

Placed PutAtRandom(const CollisionModel& model, RandomStream& random)
{
  return Put(model, random.Uniform(-0.12, 0.12), random.Uniform(-0.12, 0.12), random.Uniform(-kPi, kPi),
             random.Uniform(-kPi, kPi));
}

Vector2 ToWorld(const Placed& body, const Vector2& p, bool on_turret)
{
  const double c = on_turret ? body.cos * body.turret_cos - body.sin * body.turret_sin : body.cos;
  const double s = on_turret ? body.sin * body.turret_cos + body.cos * body.turret_sin : body.sin;
  return {body.x + c * p.x() - s * p.y(), body.y + s * p.x() + c * p.y()};
}

// Returns points all over the outline, and inside it by 0.1 mm.
std::vector<Vector2> PointsOf(const Placed& body)
{
  constexpr double kInside = 1e-4;
  std::vector<Vector2> points;
  const CollisionModel& model = *body.model;
  for (int k = 0; k < model.circles; ++k)
    for (int n = 0; n < 400; ++n)
    {
      const double angle = n * kPi / 200;
      const double radius = model.part_radius[k] - kInside;
      points.push_back(ToWorld(
          body, {model.part_x[k] + radius * std::cos(angle), model.part_y[k] + radius * std::sin(angle)}, false));
    }
  for (const Polygon& polygon : model.polygons)
    for (int k = 0; k < polygon.count; ++k)
      for (int n = 0; n < 100; ++n)
      {
        const int next = (k + 1) % polygon.count;
        const double t = n / 100.0;
        points.push_back(ToWorld(body,
                                 {polygon.x[k] + t * (polygon.x[next] - polygon.x[k]) - kInside * polygon.nx[k],
                                  polygon.y[k] + t * (polygon.y[next] - polygon.y[k]) - kInside * polygon.ny[k]},
                                 polygon.on_turret));
      }
  return points;
}

bool IsInside(const Placed& body, const Vector2& point)
{
  const CollisionModel& model = *body.model;
  for (int k = 0; k < model.circles; ++k)
    if ((ToWorld(body, {model.part_x[k], model.part_y[k]}, false) - point).norm() < model.part_radius[k]) return true;
  for (const Polygon& polygon : model.polygons)
  {
    bool inside = true;
    for (int k = 0; k < polygon.count; ++k)
    {
      const Vector2 corner = ToWorld(body, {polygon.x[k], polygon.y[k]}, polygon.on_turret);
      const Vector2 along =
          ToWorld(body, {polygon.x[k] + polygon.nx[k], polygon.y[k] + polygon.ny[k]}, polygon.on_turret) - corner;
      inside = inside && along.dot(point - corner) < 0;
    }
    if (inside) return true;
  }
  return false;
}

bool OutlinesOverlap(const Placed& a, const Placed& b)
{
  for (const Vector2& point : PointsOf(a))
    if (IsInside(b, point)) return true;
  for (const Vector2& point : PointsOf(b))
    if (IsInside(a, point)) return true;
  return false;
}

double DeepestOf(const Placed& a, const Placed& b)
{
  PairBatch batch;
  batch.Add(a, b);
  batch.FindTouches(kContactMargin);
  return batch.Deepest(0);
}

TEST(NarrowPhase, OverlapsAreThoseOfTheOutlines)
{
  const std::vector<CollisionModel> models{FootbotModel(), CircleModel(0.05), RectangleModel(0.16, 0.1)};
  RandomStream random(3, 0, 0, 0);
  int overlapping = 0;
  int apart = 0;
  for (int n = 0; n < 3000; ++n)
  {
    const Placed a = PutAtRandom(models[n % 3], random);
    const Placed b = PutAtRandom(models[n / 3 % 3], random);
    const double deepest = DeepestOf(a, b);
    if (std::abs(deepest) < 5e-4) continue;  // too fine for so few points
    ASSERT_EQ(deepest > 0, OutlinesOverlap(a, b)) << n << ": " << deepest;
    ++(deepest > 0 ? overlapping : apart);
  }
  EXPECT_GT(overlapping, 500);
  EXPECT_GT(apart, 200);
}

TEST(NarrowPhase, EachPairOfABatchHasTheTouchesThatItHasAlone)
{
  const CollisionModel footbot = FootbotModel();
  RandomStream random(4, 0, 0, 0);
  int touches = 0;
  for (int n = 0; n < 2000; ++n)
  {
    std::array<Placed, 2 * kDoubleLanes> placed;
    for (Placed& body : placed) body = PutAtRandom(footbot, random);
    PairBatch together;
    for (std::size_t k = 0; k < kDoubleLanes; ++k)
    {
      ASSERT_TRUE(together.Takes(placed[2 * k], placed[2 * k + 1]));
      together.Add(placed[2 * k], placed[2 * k + 1]);
    }
    ASSERT_TRUE(together.IsFull());
    together.FindTouches(kContactMargin);
    for (std::size_t k = 0; k < kDoubleLanes; ++k)
    {
      std::vector<Touch> expected, found;
      PairBatch alone;
      alone.Add(placed[2 * k], placed[2 * k + 1]);
      alone.FindTouches(kContactMargin);
      alone.ForEachTouch([&](std::size_t, const Touch& touch) { expected.push_back(touch); });
      together.ForEachTouch(
          [&](std::size_t lane, const Touch& touch)
          {
            if (lane == k) found.push_back(touch);
          });
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t t = 0; t < found.size(); ++t)
      {
        ASSERT_EQ(found[t].x, expected[t].x);
        ASSERT_EQ(found[t].y, expected[t].y);
        ASSERT_EQ(found[t].reach, expected[t].reach);
        ASSERT_EQ(found[t].face, expected[t].face);
        ASSERT_EQ(found[t].depth, expected[t].depth);
      }
      touches += static_cast<int>(found.size());
    }
  }
  EXPECT_GT(touches, 5000);
}

TEST(NarrowPhase, DepthsAreThoseOfGeometry)
{
  const CollisionModel disc = CircleModel(0.1);
  const CollisionModel box = RectangleModel(0.2, 0.1);
  EXPECT_NEAR(DeepestOf(Put(disc, 0, 0, 0), Put(disc, 0.21, 0, 1)), -0.01, 1e-15);
  // A face is nearest, and then a corner (3-4-5 triangle), from either side.
  EXPECT_NEAR(DeepestOf(Put(disc, 0.03, 0.14, 0), Put(box, 0, 0, 0)), 0.01, 1e-15);
  EXPECT_NEAR(DeepestOf(Put(box, 0, 0, 0), Put(disc, 0.03, 0.14, 0)), 0.01, 1e-15);
  EXPECT_NEAR(DeepestOf(Put(disc, 0.1 + 0.066, 0.05 + 0.088, 0), Put(box, 0, 0, 0)), -0.01, 1e-15);
  EXPECT_NEAR(DeepestOf(Put(box, 0, 0, 0), Put(disc, 0.1 + 0.066, 0.05 + 0.088, 0)), -0.01, 1e-15);
  // A box stands upright on another one.
  EXPECT_NEAR(DeepestOf(Put(box, 0, 0, 0), Put(box, 0.02, 0.14, kPi / 2)), 0.01, 1e-15);
  EXPECT_EQ(Overlap(Put(disc, 0, 0, 0), Put(disc, 0.3, 0, 0)), 0);
}

TEST(NarrowPhase, TouchesMuchLessDeepThanTheDeepestAreLeftOut)
{
  const CollisionModel footbot = FootbotModel();
  RandomStream random(5, 0, 0, 0);
  for (int n = 0; n < 2000; ++n)
  {
    const Placed a = PutAtRandom(footbot, random);
    const Placed b = PutAtRandom(footbot, random);
    PairBatch batch;
    batch.Add(a, b);
    batch.FindTouches(kContactMargin);
    batch.ForEachTouch(
        [&](std::size_t, const Touch& touch)
        {
          EXPECT_GE(touch.depth, batch.Deepest(0) - kTouchesApart - 1e-15);
          EXPECT_GT(touch.depth, -kContactMargin);
        });
  }
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
