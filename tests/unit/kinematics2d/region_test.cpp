// A plane that is cut into regions goes as the whole plane does, bit by bit, wherever the cuts are.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <mutex>
#include <thread>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"
#include "tests/unit/kinematics2d/region_hub.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr double kTick = 0.1;
constexpr std::uint32_t kFollowers = 6;

CollisionModel Box(double min_x, double min_y, double max_x, double max_y)
{
  const std::array<Vector2, 4> corners{Vector2(max_x, min_y), Vector2(max_x, max_y), Vector2(min_x, max_y),
                                       Vector2(min_x, min_y)};
  return MakeModel({}, {MakePolygon(corners)});
}

struct Scene
{
  double side = 15;  // m, around the origin of the plane
  double density = 10;
  double speed = 0.3;
  bool has_grips = true;
  bool has_followers = true;
  bool has_large = true;
  std::uint64_t seed = 1;

  std::uint32_t Bodies() const { return static_cast<std::uint32_t>(side * side * density); }
  bool IsFootbot(std::uint32_t body) const { return body % 10 != 3 && body % 10 != 7; }
  bool IsPrey(std::uint32_t body) const { return body % 10 == 3; }
  // Some boxes are too large for the cells.
  bool IsLarge(std::uint32_t body) const { return has_large && body % 400 == 27; }
};

Pose2 FollowerPose(const Scene& scene, std::uint32_t k, std::uint64_t tick)
{
  const double angle = 0.004 * static_cast<double>(tick) + k;
  const SinCos at = SinCosOf(angle);
  const double radius = (0.1 + 0.05 * k) * scene.side;
  return {radius * at.cos, radius * at.sin, RotorOf(angle)};
}

// Footbots, preys and boxes, followers behind them, and walls around and across.
KinematicWorld Build(const Scene& scene)
{
  KinematicWorld world(0.9);
  const std::uint32_t footbot = world.AddModel(FootbotModel());
  const std::uint32_t prey = world.AddModel(CircleModel(0.08));
  const std::uint32_t box = world.AddModel(RectangleModel(0.16, 0.1));
  const std::uint32_t plank = world.AddModel(RectangleModel(1.2, 0.1));
  const std::uint32_t count = scene.Bodies();
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  const double spacing = scene.side / columns;
  const double edge = scene.side / 2;
  RandomStream random(scene.seed, 1, 0, 0);
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const std::uint32_t model = scene.IsLarge(k) ? plank : scene.IsFootbot(k) ? footbot : scene.IsPrey(k) ? prey : box;
    // Numbers lie anywhere.
    const std::uint32_t place = static_cast<std::uint32_t>((std::uint64_t{k} * 7919) % count);
    world.AddBody(model, {(place % columns + 0.5) * spacing - edge, (place / columns + 0.5) * spacing - edge,
                          RotorOf(random.Uniform(-kPi, kPi))});
  }
  if (scene.has_followers)
    for (std::uint32_t k = 0; k < kFollowers; ++k)
      world.AddBody(scene.has_large && k == 2 ? plank : prey, FollowerPose(scene, k, 0), true);
  world.AddStatic(Box(-edge - 0.1, -edge - 0.1, -edge, edge + 0.1));
  world.AddStatic(Box(edge, -edge - 0.1, edge + 0.1, edge + 0.1));
  world.AddStatic(Box(-edge - 0.1, -edge - 0.1, edge + 0.1, -edge));
  world.AddStatic(Box(-edge - 0.1, edge, edge + 0.1, edge + 0.1));
  world.AddStatic(Box(-3, -0.1, 3, 0.1));
  world.AddStatic(MakeModel(std::array{Circle{0, 2, 0.4}}, {}));
  world.Start({-edge, -edge, edge, edge});
  return world;
}

struct GripChange
{
  std::uint32_t body;
  std::optional<std::uint32_t> prey;  // none: it lets go
};
struct Jump
{
  std::uint32_t body;
  Pose2 pose;
};
// What happens at a tick beside what follows from the numbers of the bodies, and what came of it in the whole world.
struct Tick
{
  std::vector<GripChange> grips;
  std::vector<Jump> jumps;
  std::vector<Pose2> poses;
  std::vector<double> turrets, travel;
};

// As told to body `number`.
Twist TwistAt(const Scene& scene, std::uint32_t number, std::uint64_t tick)
{
  RandomStream random(scene.seed, 2, number, tick / 10);
  const double most = number % 97 == 5 ? 4 * scene.speed : scene.speed;
  return {random.Uniform(-0.3 * most, most), 0, random.Uniform(-1, 1)};
}

void Command(const Scene& scene, KinematicWorld& world, std::uint32_t body, std::uint32_t number, std::uint64_t tick)
{
  if (!scene.IsFootbot(number)) return;
  world.SetTwist(body, TwistAt(scene, number, tick));
  world.SetTurretRate(body, number % 3 == 0 ? RandomStream(scene.seed, 3, number, tick / 7).Uniform(-1, 1) : 0);
  if (number % 53 == 1) world.SetPresent(body, tick / 11 % 3 != 0);
}

void MoveFollowers(const Scene& scene, std::uint64_t tick,
                   const std::function<void(std::uint32_t, const Pose2&, bool)>& follow)
{
  if (!scene.has_followers) return;
  for (std::uint32_t k = 0; k < kFollowers; ++k)
    follow(scene.Bodies() + k, FollowerPose(scene, k, tick), (tick / 40 + k) % 4 != 0);
}

// Footbots near a prey take it, some of those that hold one let go.
std::vector<GripChange> ChooseGrips(const Scene& scene, const KinematicWorld& world, std::uint64_t tick)
{
  std::vector<GripChange> changes;
  if (!scene.has_grips) return changes;
  const auto is_held = [&](std::uint32_t body)
  { return std::ranges::any_of(world.Grips(), [&](const Grip& grip) { return grip.prey == body; }); };
  for (std::uint32_t body = 0; body < scene.Bodies(); ++body)
  {
    if (!scene.IsFootbot(body) || (body + tick) % 40 != 0) continue;
    if (world.FindGrip(body) != nullptr)
    {
      changes.push_back({body, std::nullopt});
      continue;
    }
    for (std::uint32_t prey = 3; prey < scene.Bodies() && body % 4 == 0; prey += 10)
    {
      const double dx = world.PoseOf(prey).x - world.PoseOf(body).x;
      const double dy = world.PoseOf(prey).y - world.PoseOf(body).y;
      if (dx * dx + dy * dy > 0.2 * 0.2 || is_held(body)) continue;
      changes.push_back({body, prey});
      break;
    }
  }
  return changes;
}

struct Story
{
  std::vector<Tick> ticks;
  std::vector<char> saved;  // before the first tick that is told
  std::uint64_t first = 0;
  WorldStatistics most;
  std::size_t most_grips = 0;
};

// The whole world through `ticks` ticks, after `before` of them that are not told.
Story Tell(const Scene& scene, std::uint64_t before, std::uint64_t ticks)
{
  Story story;
  KinematicWorld world = Build(scene);
  world.KeepTravel();
  for (std::uint64_t tick = 0; tick < before + ticks; ++tick)
  {
    if (tick == before)
    {
      ByteWriter saved;
      world.SaveState(saved);
      story.saved = saved.Bytes();
      story.first = before;
    }
    Tick now;
    now.grips = ChooseGrips(scene, world, tick);
    if (tick % 16 == 9)
    {
      const auto body = static_cast<std::uint32_t>(8 + tick * 10 % (scene.Bodies() - 20));
      if (world.FindGrip(body) == nullptr && !scene.IsPrey(body))
        now.jumps.push_back({body, {0.4 * scene.side * RandomStream(scene.seed, 4, 0, tick).Uniform(-1, 1), -1, {}}});
    }
    for (const GripChange& change : now.grips)
      if (change.prey)
        world.AddGrip(change.body, *change.prey);
      else
        world.RemoveGrip(change.body);
    for (const Jump& jump : now.jumps) world.Place(jump.body, jump.pose);
    for (std::uint32_t body = 0; body < scene.Bodies(); ++body) Command(scene, world, body, body, tick);
    MoveFollowers(scene, tick, [&](std::uint32_t n, const Pose2& p, bool here) { world.Follow(n, p, here); });
    world.Advance(kTick, 1);
    story.most.substeps = std::max(story.most.substeps, world.Statistics().substeps);
    story.most.held_back = std::max(story.most.held_back, world.Statistics().held_back);
    story.most_grips = std::max(story.most_grips, world.Grips().size());
    if (tick < before) continue;
    for (std::uint32_t body = 0; body < scene.Bodies(); ++body)
    {
      now.poses.push_back(world.PoseOf(body));
      now.turrets.push_back(world.TurretAngle(body));
      now.travel.push_back(world.TravelForward(body) + world.TravelTurn(body));
    }
    story.ticks.push_back(std::move(now));
  }
  return story;
}

bool SameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Which block is whose at a tick.
using Cuts = std::function<std::vector<std::uint8_t>(std::uint32_t columns, std::uint32_t blocks, std::uint64_t tick)>;

struct Outcome
{
  std::uint64_t differences = 0;  // of bodies and ticks
  std::string first;              // of them
  std::string error;              // of the first region that failed
  std::size_t most_held = 0;
};

// The same with a world for each region, compared after each tick.
Outcome Retell(const Scene& scene, const Story& story, unsigned regions, const Cuts& cuts, unsigned halo = 1)
{
  Hub hub(regions);
  std::mutex mutex;
  Outcome outcome;
  std::vector<std::uint32_t> seen(story.ticks.size());  // own bodies of all regions
  const auto run = [&](unsigned region)
  {
    HubExchange exchange(hub, region);
    KinematicWorld world = Build(scene);
    world.KeepTravel();
    ByteReader saved(story.saved);
    world.LoadState(saved);
    const auto cuts_at = [&](std::uint64_t tick) { return cuts(world.BlockColumns(), world.BlockCount(), tick); };
    world.BecomeRegion(region, cuts_at(0), exchange, halo);
    for (std::uint64_t n = 0; n < story.ticks.size(); ++n)
    {
      const Tick& told = story.ticks[n];
      const std::uint64_t tick = story.first + n;
      if (n > 0) world.MoveCuts(cuts_at(n));
      for (const GripChange& change : told.grips)
      {
        const std::uint32_t body = world.FindBody(change.body);
        if (body == world.BodyCount() || !world.IsOwn(body)) continue;
        if (change.prey)
          world.AddGrip(body, world.FindBody(*change.prey));
        else
          world.RemoveGrip(body);
      }
      for (const Jump& jump : told.jumps)
      {
        const std::uint32_t body = world.FindBody(jump.body);
        if (body < world.BodyCount() && world.IsOwn(body)) world.Place(body, jump.pose);
      }
      for (std::uint32_t body = 0; body < world.BodyCount(); ++body)
        if (world.IsOwn(body)) Command(scene, world, body, world.NumberInWhole(body), tick);
      MoveFollowers(scene, tick,
                    [&](std::uint32_t k, const Pose2& p, bool here) { world.Follow(world.FindBody(k), p, here); });
      world.Advance(kTick, 1);

      const std::lock_guard lock(mutex);
      outcome.most_held = std::max(outcome.most_held, world.BodyCount());
      for (std::uint32_t body = 0; body < world.BodyCount(); ++body)
      {
        const std::uint32_t number = world.NumberInWhole(body);
        if (!world.IsOwn(body)) continue;
        ++seen[n];
        const Pose2 pose = world.PoseOf(body);
        const Pose2& expected = told.poses[number];
        if (!SameBits(pose.x, expected.x) || !SameBits(pose.y, expected.y) ||
            !SameBits(pose.heading.z, expected.heading.z) || !SameBits(pose.heading.w, expected.heading.w) ||
            !SameBits(world.TurretAngle(body), told.turrets[number]) ||
            !SameBits(world.TravelForward(body) + world.TravelTurn(body), told.travel[number]))
        {
          if (outcome.differences++ == 0)
            outcome.first = "body " + std::to_string(number) + " in region " + std::to_string(region) + " at tick " +
                            std::to_string(tick);
        }
      }
    }
  };
  std::vector<std::thread> threads;
  for (unsigned region = 0; region < regions; ++region)
    threads.emplace_back(
        [&, region]
        {
          try
          {
            run(region);
          }
          catch (const std::exception& error)
          {
            const std::lock_guard lock(mutex);
            if (outcome.error.empty()) outcome.error = error.what();
          }
          hub.Break();
        });
  for (std::thread& thread : threads) thread.join();
  if (!outcome.error.empty()) return outcome;
  for (const std::uint32_t bodies : seen) EXPECT_EQ(bodies, scene.Bodies()) << "each body has one region";
  return outcome;
}

void ExpectSame(const Scene& scene, const Story& story, unsigned regions, const Cuts& cuts)
{
  const Outcome outcome = Retell(scene, story, regions, cuts);
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.differences, 0U) << outcome.first;
}

// Columns of blocks from left to right, in about equal numbers.
std::vector<std::uint8_t> Strips(unsigned regions, std::uint32_t columns, std::uint32_t blocks)
{
  std::vector<std::uint8_t> cut(blocks);
  for (std::uint32_t k = 0; k < blocks; ++k) cut[k] = static_cast<std::uint8_t>(k % columns * regions / columns);
  return cut;
}

std::vector<std::uint8_t> Quadrants(std::uint32_t columns, std::uint32_t blocks)
{
  const std::uint32_t rows = blocks / columns;
  std::vector<std::uint8_t> cut(blocks);
  for (std::uint32_t k = 0; k < blocks; ++k)
    cut[k] = static_cast<std::uint8_t>((k / columns * 2 / rows) * 2 + k % columns * 2 / columns);
  return cut;
}

// Each block anywhere.
std::vector<std::uint8_t> Scattered(unsigned regions, std::uint32_t blocks, std::uint64_t seed)
{
  RandomStream random(seed, 5, 0, 0);
  std::vector<std::uint8_t> cut(blocks);
  for (std::uint8_t& region : cut) region = static_cast<std::uint8_t>(random.Uniform(0, regions));
  return cut;
}

TEST(KinematicRegions, ACrowdWithGripsMirrorsAndWallsGoesAsInOneWorldWhereverItIsCut)
{
  const Scene scene;
  const Story story = Tell(scene, 0, 150);
  EXPECT_GT(story.most_grips, 20U);
  EXPECT_GT(story.most.substeps, 1);
  EXPECT_GT(story.most.held_back, 5U);
  ExpectSame(scene, story, 1, [](auto, auto blocks, auto) { return std::vector<std::uint8_t>(blocks, 0); });
  ExpectSame(scene, story, 2, [](auto columns, auto blocks, auto) { return Strips(2, columns, blocks); });
  ExpectSame(scene, story, 4, [](auto columns, auto blocks, auto) { return Quadrants(columns, blocks); });
  ExpectSame(scene, story, 3, [](auto, auto blocks, auto) { return Scattered(3, blocks, 7); });
}

TEST(KinematicRegions, CutsMayMoveWhileACrowdIsPacked)
{
  Scene scene;
  scene.side = 12;
  scene.density = 20;
  scene.seed = 2;
  // From a saved state, as a worker that takes the place of another one begins.
  const Story story = Tell(scene, 30, 60);
  EXPECT_GT(story.most.held_back, 100U);
  const auto slide = [](auto columns, auto blocks, std::uint64_t tick)
  {
    std::vector<std::uint8_t> cut(blocks);
    for (std::uint32_t k = 0; k < blocks; ++k) cut[k] = k % columns < tick / 10 % (columns + 1) ? 0 : 1;
    return cut;
  };
  ExpectSame(scene, story, 2, slide);
  ExpectSame(scene, story, 4, [](auto, auto blocks, auto tick) { return Scattered(4, blocks, tick / 5); });
}

TEST(KinematicRegions, RandomWorldsGoAsInOneWhereverTheCutsJumpInEachTick)
{
  for (std::uint64_t seed = 10; seed < 16; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed, 6, 0, 0);
    Scene scene;
    scene.seed = seed;
    scene.side = random.Uniform(6, 11);
    scene.density = random.Uniform(4, 20);
    scene.speed = random.Uniform(0.05, 1);
    scene.has_grips = seed % 2 == 0;
    scene.has_followers = seed % 3 != 0;
    const auto regions = static_cast<unsigned>(random.Uniform(2, 6));
    ExpectSame(scene, Tell(scene, 0, 40), regions,
               [&](auto, auto blocks, auto tick) { return Scattered(regions, blocks, seed + tick); });
  }
}

TEST(KinematicRegions, ARegionHoldsItsBodiesAndOneCellAroundThem)
{
  Scene scene;
  scene.density = 6;
  scene.has_grips = false;
  const Story story = Tell(scene, 0, 20);
  const Cuts quadrants = [](auto columns, auto blocks, auto) { return Quadrants(columns, blocks); };
  const Outcome one = Retell(scene, story, 4, quadrants, 1);
  EXPECT_EQ(one.differences, 0U) << one.first;
  EXPECT_LT(one.most_held, scene.Bodies() * 45 / 100) << "of the largest quadrant";
  // More than needed changes nothing.
  const Outcome two = Retell(scene, story, 4, quadrants, 2);
  EXPECT_EQ(two.differences, 0U) << two.first;
  EXPECT_GT(two.most_held, one.most_held);
  // Less is not enough.
  const Outcome none = Retell(scene, story, 4, quadrants, 0);
  EXPECT_TRUE(none.differences > 0 || !none.error.empty());
}

TEST(KinematicRegions, CutsThatAreNoneAreRefused)
{
  const auto refusal = [](const Cuts& cuts)
  {
    Scene scene;
    scene.side = 8;
    return Retell(scene, Tell(scene, 0, 1), 2, cuts).error;
  };
  EXPECT_NE(refusal([](auto, auto blocks, auto) { return std::vector<std::uint8_t>(blocks, 2); })
                .find("there is no region 2"),
            std::string::npos);
  EXPECT_NE(refusal([](auto, auto blocks, auto) { return std::vector<std::uint8_t>(blocks + 1, 0); })
                .find("there must be a region for each of its"),
            std::string::npos);
}

TEST(KinematicRegions, ASpeedBeyondAllSenseInOneRegionIsRefusedByAll)
{
  Hub hub(2);
  std::array<std::string, 2> errors;
  const auto run = [&](unsigned region)
  {
    HubExchange exchange(hub, region);
    Scene scene;
    KinematicWorld world = Build(scene);
    const std::vector<std::uint8_t> cut = Strips(2, world.BlockColumns(), world.BlockCount());
    world.BecomeRegion(region, cut, exchange);
    const std::uint32_t body = world.FindBody(0);
    if (world.IsOwn(body)) world.SetTwist(body, {1e6, 0, 0});
    try
    {
      world.Advance(kTick, 1);
    }
    catch (const std::runtime_error& error)
    {
      errors[region] = error.what();
    }
  };
  std::thread other(run, 1);
  run(0);
  other.join();
  EXPECT_NE(errors[0].find("is told to move 100000"), std::string::npos) << errors[0];
  EXPECT_EQ(errors[0], errors[1]);
}

}  // namespace
}  // namespace swarmanoid::kinematics2d
