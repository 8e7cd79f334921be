// Crowds never overlap: random worlds against a measure of overlap that shares nothing with the engine.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kCrowdTick = 0.1;

// A disc (one point and a radius) or a convex polygon (no radius), in the frame of its body.
struct Shape
{
  std::vector<Vector2> points;
  double radius = 0;
  bool on_turret = false;
};
using Outline = std::vector<Shape>;

Shape Rectangle(double min_x, double min_y, double max_x, double max_y)
{
  return {{{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}}};
}

// The outline is that of figure 3.9 of the documentation.
Outline Footbot()
{
  Shape gripper = Rectangle(0.07, -0.015, 0.1, 0.015);
  gripper.on_turret = true;
  return {{{{0, 0}}, 0.085036758}, {{{0, 0.07}}, 0.029112741}, {{{0, -0.07}}, 0.029112741}, gripper};
}

CollisionModel ModelOf(const Outline& outline)
{
  std::vector<Circle> circles;
  std::vector<Polygon> polygons;
  for (const Shape& shape : outline)
    if (shape.points.size() == 1)
      circles.push_back({shape.points[0].x(), shape.points[0].y(), shape.radius});
    else
    {
      polygons.push_back(MakePolygon(shape.points));
      polygons.back().on_turret = shape.on_turret;
    }
  return MakeModel(circles, polygons);
}

Shape ShapeAt(const Shape& shape, double x, double y, double heading, double turret)
{
  const double angle = shape.on_turret ? heading + turret : heading;
  Shape placed{{}, shape.radius};
  for (const Vector2& p : shape.points)
    placed.points.emplace_back(x + std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                               y + std::sin(angle) * p.x() + std::cos(angle) * p.y());
  return placed;
}

// Returns how far the projections of two shapes on a unit vector overlap; negative if they are apart.
double OverlapAlong(const Shape& a, const Shape& b, const Vector2& axis)
{
  const auto highest = [](const Shape& shape, const Vector2& along)
  {
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector2& p : shape.points) most = std::max(most, p.dot(along));
    return most + shape.radius;
  };
  return std::min(highest(a, axis) + highest(b, -axis), highest(b, axis) + highest(a, -axis));
}

// The shortest way that parts two convex shapes; negative if they are apart. By the theorem of separating axes: the
// axes are the normals of edges and the lines from a disc's centre to points of the other shape.
double OverlapOf(const Shape& a, const Shape& b)
{
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vector2& axis)
  {
    if (axis.norm() > 0) least = std::min(least, OverlapAlong(a, b, axis.normalized()));
  };
  for (const Shape* shape : {&a, &b})
  {
    const Shape& other = shape == &a ? b : a;
    const std::size_t count = shape->points.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const Vector2 edge = shape->points[(k + 1) % count] - shape->points[k];
      consider({edge.y(), -edge.x()});
      if (count == 1)
        for (const Vector2& p : other.points) consider(p - shape->points[0]);
    }
  }
  return least;
}

// It holds a world and the outlines in it.
struct Crowd
{
  KinematicWorld world;
  std::vector<Outline> outlines;  // outline of each body
  std::vector<Shape> walls;

  std::uint32_t Add(const Outline& outline, double x, double y, double heading, bool follower = false)
  {
    outlines.push_back(outline);
    return world.AddBody(world.AddModel(ModelOf(outline)), {x, y, RotorOf(heading)}, follower);
  }
  void AddWall(double min_x, double min_y, double max_x, double max_y)
  {
    walls.push_back(Rectangle(min_x, min_y, max_x, max_y));
    world.AddStatic(ModelOf({walls.back()}));
  }
  void AddWallsAround(double width, double height)
  {
    AddWall(-0.1, -0.1, 0, height + 0.1);
    AddWall(width, -0.1, width + 0.1, height + 0.1);
    AddWall(-0.1, -0.1, width + 0.1, 0);
    AddWall(-0.1, height, width + 0.1, height + 0.1);
  }
  std::vector<Outline> PlacedOutlines() const
  {
    std::vector<Outline> placed(outlines.size());
    for (std::uint32_t k = 0; k < outlines.size(); ++k)
    {
      const Pose2 pose = world.PoseOf(k);
      const double heading = 2 * std::atan2(pose.heading.z, pose.heading.w);
      for (const Shape& shape : outlines[k])
        placed[k].push_back(ShapeAt(shape, pose.x, pose.y, heading, world.TurretAngle(k)));
    }
    return placed;
  }
};

double Deepest(const Outline& a, const Outline& b)
{
  double deepest = -std::numeric_limits<double>::infinity();
  for (const Shape& p : a)
    for (const Shape& q : b) deepest = std::max(deepest, OverlapOf(p, q));
  return deepest;
}

// Returns the deepest overlap of any two bodies, and of any with a wall. `skips(a, b)`: pairs that do not count.
template <class Skips>
double DeepestOverlap(const Crowd& scene, double widest, const Skips& skips)
{
  const std::vector<Outline> placed = scene.PlacedOutlines();
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::uint32_t a = 0; a < placed.size(); ++a)
  {
    for (const Shape& wall : scene.walls)
      if (!skips(a, a)) deepest = std::max(deepest, Deepest(placed[a], {wall}));
    for (std::uint32_t b = a + 1; b < placed.size(); ++b)
    {
      const double dx = scene.world.Poses().x[a] - scene.world.Poses().x[b];
      const double dy = scene.world.Poses().y[a] - scene.world.Poses().y[b];
      if (dx * dx + dy * dy < widest * widest && !skips(a, b))
        deepest = std::max(deepest, Deepest(placed[a], placed[b]));
    }
  }
  return deepest;
}

TEST(KinematicCrowd, BlindRobotsNeverOverlapAtAnyDensityAndSpeed)
{
  // Footbots that sense no other robot, on a grid within walls. Each drives a curve, and gets another one every second
  // or two.
  for (const int steps : {1, 3})
    for (const double speed : {0.05, 0.08, 0.1, 0.12, 0.3})
      for (const double spacing : {0.2, 0.21, 0.25, 0.33})
      {
        Crowd scene;
        constexpr int kColumns = 9;
        const double side = kColumns * spacing + 0.02;
        for (int k = 0; k < kColumns * kColumns; ++k)
          scene.Add(Footbot(), (k % kColumns + 0.5) * spacing + 0.01, (k / kColumns + 0.5) * spacing + 0.01, 0);
        scene.AddWallsAround(side, side);
        scene.world.Start({0, 0, side, side});
        const auto all = [](std::uint32_t, std::uint32_t) { return false; };
        ASSERT_LE(DeepestOverlap(scene, 0.2, all), 1e-9);
        for (unsigned tick = 0; tick < 60; ++tick)
        {
          for (std::uint32_t k = 0; k < kColumns * kColumns; ++k)
          {
            RandomStream random(17, k, 0, tick / (10 + k % 11));
            const double left = speed * random.Uniform(0.4, 1);
            const double right = speed * random.Uniform(0.4, 1);
            scene.world.SetTwist(k, {(left + right) / 2, 0, (right - left) / kFootbotInterWheel});
          }
          scene.world.Advance(kCrowdTick, steps);
          ASSERT_LE(DeepestOverlap(scene, 0.2, all), scene.world.AllowedOverlapForTest() + 1e-9)
              << "speed " << speed << " spacing " << spacing << " steps " << steps << " tick " << tick;
        }
        EXPECT_LT(scene.world.AllowedOverlapForTest(), 0.35e-3);
      }
}

TEST(KinematicCrowd, OutlinesOfAllKindsGripsTurretsAndMirrorsNeverOverlap)
{
  for (unsigned seed = 1; seed <= 24; ++seed)
  {
    RandomStream random(31, seed, 0, 0);
    const auto one_of = [&random](std::uint32_t count)
    { return static_cast<std::uint32_t>(random.Uniform(0, 1) * count) % count; };
    Crowd scene;
    const double spacing = random.Uniform(0.24, 0.3);
    constexpr std::uint32_t kColumns = 8;
    const double width = kColumns * spacing;
    const std::vector<Outline> kinds{Footbot(),
                                     Footbot(),
                                     {{{{0, 0}}, 0.1}},
                                     {Rectangle(-0.11, -0.04, 0.11, 0.04)},
                                     {{{{0.1, 0}, {-0.03, 0.09}, {-0.08, -0.08}}}}};
    std::vector<std::uint32_t> kind;
    for (std::uint32_t k = 0; k < kColumns * kColumns; ++k)
    {
      kind.push_back(one_of(static_cast<std::uint32_t>(kinds.size())));
      const double heading = spacing > 0.25 ? random.Uniform(-kPi, kPi) : 0;
      scene.Add(kinds[kind[k]], (k % kColumns + 0.5) * spacing, (k / kColumns + 0.5) * spacing, heading);
    }
    // Above the others: preys with three robots each, and mirrors.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> grips;
    std::vector<std::uint32_t> mirrors;
    double y = width;
    for (int group = 0; group < 2; ++group)
    {
      const double x = 0.5 + 0.9 * group;
      const auto prey = scene.Add({{{{0, 0}}, 0.12}}, x, y + 0.4, 0);
      for (int k = 0; k < 3; ++k)
      {
        const double angle = 2 * kPi * k / 3 + group;
        const auto robot =
            scene.Add(Footbot(), x + 0.225 * std::cos(angle), y + 0.4 + 0.225 * std::sin(angle), angle + kPi);
        grips.emplace_back(robot, prey);
      }
    }
    y += 0.85;
    for (int k = 0; k < 2; ++k) mirrors.push_back(scene.Add(Footbot(), 0.3 + 1.2 * k, y, -kPi / 2, true));
    scene.AddWallsAround(width, y + 0.15);
    scene.world.Start({0, 0, width, y + 0.15});
    for (const auto& [robot, prey] : grips) scene.world.AddGrip(robot, prey);

    // A mirror gives way to no body, and may press the bodies that it meets.
    const auto with_mirrors = [&](std::uint32_t a, std::uint32_t b) { return a >= mirrors[0] || b >= mirrors[0]; };
    ASSERT_LE(DeepestOverlap(scene, 0.3, with_mirrors), 1e-9) << seed;
    const double speed = random.Uniform(0.05, 0.4);
    const double turn = random.Uniform(0.2, 4);
    const int steps = 1 + static_cast<int>(one_of(3));
    double deepest_in_mirror = 0;
    for (unsigned tick = 0; tick < 60; ++tick)
    {
      for (std::uint32_t k = 0; k < mirrors[0]; ++k)
      {
        RandomStream command(32, k, seed, tick / 7);
        const bool passive = k < kind.size() && kind[k] > 2;
        const Twist twist{speed * command.Uniform(-0.3, 1), kind.size() > k && kind[k] == 2 ? 0.3 * speed : 0,
                          turn * command.Uniform(-1, 1)};
        scene.world.SetTwist(k, passive ? Twist{} : twist);
        if (scene.outlines[k].size() == 4) scene.world.SetTurretRate(k, command.Uniform(-2, 2));
      }
      double way = 0;
      for (const std::uint32_t mirror : mirrors)
      {
        Pose2 pose = scene.world.PoseOf(mirror);
        const double from = pose.y;
        pose.y = std::max(0.2, pose.y - 0.01);
        way = from - pose.y;
        scene.world.Follow(mirror, scene.world.PoseOf(mirror), pose, true);
      }
      scene.world.Advance(kCrowdTick, steps);
      ASSERT_LE(DeepestOverlap(scene, 0.3, with_mirrors), scene.world.AllowedOverlapForTest() + 1e-9)
          << "seed " << seed << " tick " << tick;
      // A mirror enters a body no faster than it moves.
      const double in_mirror = DeepestOverlap(
          scene, 0.3, [&](std::uint32_t a, std::uint32_t b) { return a >= mirrors[0] || b < mirrors[0]; });
      ASSERT_LE(in_mirror, std::max(deepest_in_mirror, scene.world.AllowedOverlapForTest()) + way + 1e-9) << seed;
      deepest_in_mirror = in_mirror;
    }
  }
}

TEST(KinematicCrowd, WhoWasPutIntoOthersPartsFromThemAndNeverSinksDeeper)
{
  Crowd scene;
  for (int k = 0; k < 36; ++k) scene.Add(Footbot(), 0.25 * (k % 6), 0.25 * (k / 6), 0);
  scene.world.Start({-1, -1, 2, 2});
  scene.world.Place(0, {0.55, 0.6, RotorOf(1)});
  const auto not_the_one = [](std::uint32_t a, std::uint32_t) { return a == 0; };
  const auto only_the_one = [](std::uint32_t a, std::uint32_t) { return a != 0; };
  double before = DeepestOverlap(scene, 0.2, only_the_one);
  ASSERT_GT(before, 0.05);
  for (unsigned tick = 0; tick < 100; ++tick)
  {
    for (std::uint32_t k = 0; k < 36; ++k)
    {
      RandomStream random(5, k, 0, tick / 9);
      scene.world.SetTwist(k, {0.05 * random.Uniform(-1, 1), 0, random.Uniform(-1, 1)});
    }
    scene.world.Advance(kCrowdTick, 1);
    ASSERT_LE(DeepestOverlap(scene, 0.2, not_the_one), scene.world.AllowedOverlapForTest() + 1e-9) << tick;
    const double now = DeepestOverlap(scene, 0.2, only_the_one);
    ASSERT_LE(now, std::max(before, scene.world.AllowedOverlapForTest()) + 1e-9) << tick;
    before = now;
  }
  EXPECT_LT(before, scene.world.AllowedOverlapForTest() + 1e-9);
}

// Returns the ticks until two bodies of these outlines are apart, if one is put `offset` (m) from the other and both
// are driven at random, with odd seeds always in the same way. `first_is_wall`: the first outline never moves.
int TicksUntilApart(const Outline& first, const Outline& second, double offset, bool first_is_wall, unsigned seed)
{
  RandomStream random(41, seed, 0, 0);
  Crowd scene;
  const double direction = random.Uniform(-kPi, kPi);
  const Pose2 pose{1 + offset * std::cos(direction), 1 + offset * std::sin(direction),
                   RotorOf(random.Uniform(-kPi, kPi))};
  if (first_is_wall)
  {
    scene.walls.push_back(ShapeAt(first[0], 1, 1, random.Uniform(-kPi, kPi), 0));
    scene.world.AddStatic(ModelOf({scene.walls.back()}));
  }
  else
    scene.Add(first, 1, 1, random.Uniform(-kPi, kPi));
  const std::uint32_t put = scene.Add(second, 5, 5, 0);
  scene.world.Start({0, 0, 6, 6});
  scene.world.Place(put, pose);
  const auto all = [](std::uint32_t, std::uint32_t) { return false; };
  for (int tick = 0; tick < 200; ++tick)
  {
    if (DeepestOverlap(scene, 1, all) <= scene.world.AllowedOverlapForTest() + 1e-9) return tick;
    for (std::uint32_t k = 0; k <= put; ++k)
    {
      RandomStream command(42, k, seed, seed % 2 == 0 ? static_cast<std::uint64_t>(tick) / 9 : 0);
      scene.world.SetTwist(k, {0.05 * command.Uniform(-1, 1), 0, command.Uniform(-1, 1)});
    }
    scene.world.Advance(kCrowdTick, 1);
  }
  return 200;
}

TEST(KinematicCrowd, BodiesThatWerePutIntoEachOtherPartWhereverAndHoweverTheyStand)
{
  const Outline prey{{{{0, 0}}, 0.1}};
  const Outline rectangle{Rectangle(-0.11, -0.04, 0.11, 0.04)};
  const Outline triangle{{{{0.1, 0}, {-0.03, 0.09}, {-0.08, -0.08}}}};
  const Outline wall{Rectangle(-0.8, -0.05, 0.8, 0.05)};
  const std::vector<Outline> kinds{Footbot(), prey, rectangle, triangle};
  // 0.4 m at the most, by 2.5 mm a substep and body.
  constexpr int kMost = 90;
  for (const double offset : {0.0, 0.001, 0.02, 0.05, 0.08, 0.1, 0.12, 0.15, 0.18})
    for (unsigned seed = 0; seed < 30; ++seed)
      for (std::size_t a = 0; a < kinds.size(); ++a)
      {
        for (std::size_t b = a; b < kinds.size(); ++b)
          EXPECT_LT(TicksUntilApart(kinds[a], kinds[b], offset, false, seed), kMost)
              << "kinds " << a << " and " << b << " at " << offset << " seed " << seed;
        EXPECT_LT(TicksUntilApart(wall, kinds[a], offset, true, seed), kMost)
            << "kind " << a << " in a wall at " << offset << " seed " << seed;
      }
}

TEST(KinematicCrowd, ACrowdThatDrivesOnTogetherIsNotHeldByAJamElsewhere)
{
  // Twenty discs are in a row, a tenth of a millimetre apart, and five press each other against a wall.
  Crowd scene;
  const Outline disc{{{{0, 0}}, 0.085}};
  for (int k = 0; k < 20; ++k) scene.Add(disc, 0.1701 * k, 0, 0);
  for (int k = 0; k < 5; ++k) scene.Add(disc, 0.09 + 0.171 * k, 2, kPi);
  scene.AddWall(-0.1, 1, 0, 3);
  scene.world.Start({-1, -1, 5, 3});
  for (std::uint32_t k = 0; k < 25; ++k) scene.world.SetTwist(k, {0.1, 0, 0});
  for (int tick = 1; tick <= 30; ++tick)
  {
    scene.world.Advance(kCrowdTick, 1);
    for (std::uint32_t k = 0; k < 20; ++k) ASSERT_NEAR(scene.world.Poses().x[k], 0.1701 * k + 0.01 * tick, 1e-12);
    for (std::uint32_t k = 20; k < 25; ++k) ASSERT_GT(scene.world.Poses().x[k], 0.084);
  }
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
