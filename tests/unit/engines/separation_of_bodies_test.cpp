// The bodies that can meet no other body within a tick are those that a comparison of all pairs finds.
#include "engine_worker/engines/rigid_bodies/separation_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

// Returns the distance of a point from a square, by another way than the product's: in the frame of the square.
double DistanceFromSquare(const Vector2& middle, double half, double angle, const Vector2& point)
{
  const Vector2 offset = point - middle;
  const double x = std::abs(std::cos(angle) * offset.x() + std::sin(angle) * offset.y()) - half;
  const double y = std::abs(std::cos(angle) * offset.y() - std::sin(angle) * offset.x()) - half;
  return x > 0 && y > 0 ? std::sqrt(x * x + y * y) : std::max(x, y);
}

TEST(SeparationTest, IsWhatComparingEachWithEachFinds)
{
  int count[3] = {};
  for (std::uint32_t trial = 0; trial < 1000; ++trial)
  {
    RandomStream random(5, trial, 0, 0);
    const double size = random.Uniform(1, 12);
    const auto bodies = static_cast<std::size_t>(random.Uniform(1, 80));
    std::vector<MovingOutline> outlines(bodies);
    const bool has_large = random.Uniform(0, 1) < 0.5;
    for (MovingOutline& outline : outlines)
    {
      MovingCircle& whole = outline.whole;
      whole = {random.Uniform(0, size), random.Uniform(0, size), random.Uniform(0.05, 0.12), random.Uniform(0, 0.1)};
      if (has_large && random.Uniform(0, 1) < 0.1) whole.radius = random.Uniform(0.5, 1.5);
      outline.present = random.Uniform(0, 1) < 0.9;
      outline.part_count = random.Uniform(0, 1) < 0.5 ? 2 : 0;
    }
    struct Square
    {
      Vector2 middle;
      double half, angle;
    };
    std::vector<Square> squares;
    std::vector<StaticOutline> statics;
    for (int i = 0; i < 5; ++i)
    {
      const Square& square = squares.emplace_back(
          Square{{random.Uniform(0, size), random.Uniform(0, size)}, random.Uniform(0.02, 1), random.Uniform(-3, 3)});
      StaticOutline& outline = statics.emplace_back();
      for (int corner = 0; corner < 4; ++corner)
      {
        const double at = square.angle + kPi / 4 + corner * kPi / 2;
        outline.corners.emplace_back(square.middle +
                                     std::sqrt(2.0) * square.half * Vector2(std::cos(at), std::sin(at)));
      }
    }
    const MovingCircle pillar{random.Uniform(0, size), random.Uniform(0, size), 0.3, 0};
    statics.push_back({{{pillar.x, pillar.y}}, pillar.radius});

    SeparationTest isolation;
    isolation.Configure(outlines, statics, 0.1);
    // Elsewhere than they were when the cells were made, also outside of all cells.
    for (MovingOutline& outline : outlines)
    {
      MovingCircle& whole = outline.whole;
      whole.x += random.Uniform(-1, 1);
      whole.y += random.Uniform(-1, 1);
      // Parts that stay inside.
      const double angle = random.Uniform(-3, 3);
      const double inner = 0.7 * whole.radius;
      outline.parts = {
          {{whole.x, whole.y, inner, whole.way / 2},
           {whole.x + inner * std::cos(angle), whole.y + inner * std::sin(angle), whole.radius - inner, whole.way}}};
    }
    const double margin = random.Uniform(0, 0.05);
    std::vector<Nearness> found;
    std::vector<kinematics2d::Pair> near;
    EXPECT_TRUE(isolation.Find(outlines, margin, found, &near));
    std::vector<std::pair<std::size_t, std::size_t>> near_pairs;
    for (const kinematics2d::Pair& pair : near) near_pairs.emplace_back(pair.first, pair.second);
    std::ranges::sort(near_pairs);
    EXPECT_EQ(std::ranges::adjacent_find(near_pairs), near_pairs.end());
    for (std::size_t a = 0; a < bodies; ++a)
    {
      if (!outlines[a].present) continue;
      double gap = 1e9;
      for (const MovingCircle& part : outlines[a].Parts())
      {
        const auto note = [&](double distance) { gap = std::min(gap, distance - part.radius - part.way); };
        note(std::hypot(pillar.x - part.x, pillar.y - part.y) - pillar.radius);
        for (const Square& square : squares)
          note(DistanceFromSquare(square.middle, square.half, square.angle, {part.x, part.y}));
        for (std::size_t b = 0; b < bodies; ++b)
          if (b != a && outlines[b].present)
            for (const MovingCircle& other : outlines[b].Parts())
              note(std::hypot(other.x - part.x, other.y - part.y) - other.radius - other.way);
      }
      if (std::min(std::abs(gap - margin), std::abs(gap - margin - SeparationTest::kBand)) < 1e-9) continue;
      const Nearness expected = gap < margin                           ? Nearness::kNear
                                : gap < margin + SeparationTest::kBand ? Nearness::kClose
                                                                       : Nearness::kFar;
      ASSERT_EQ(found[a], expected) << "trial " << trial << ", body " << a << ", gap " << gap;
      ++count[static_cast<int>(expected)];
      const bool is_in_pair =
          std::ranges::any_of(near_pairs, [&](const auto& pair) { return pair.first == a || pair.second == a; });
      ASSERT_EQ(is_in_pair, expected == Nearness::kNear) << "trial " << trial << ", body " << a;
    }
  }
  EXPECT_GT(*std::ranges::min_element(count), 100) << "all three occur";
}

TEST(SeparationTest, NobodyIsFarWhereSomebodyIsTooFast)
{
  std::vector<MovingOutline> outlines(2);
  outlines[0].whole = {0, 0, 0.1, 0};
  outlines[1].whole = {50, 0, 0.1, 0.3};
  SeparationTest isolation;
  isolation.Configure(outlines, {}, 0.1);
  std::vector<Nearness> found;
  EXPECT_FALSE(isolation.Find(outlines, 0.02, found));
  EXPECT_EQ(found[0], Nearness::kNear);
  outlines[1].whole.way = 0.1;
  isolation.Find(outlines, 0.02, found);
  EXPECT_EQ(found[0], Nearness::kFar);
}

}  // namespace
}  // namespace swarmanoid
