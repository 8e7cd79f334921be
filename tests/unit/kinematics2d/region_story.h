// A series of events in a world of the kinematic engine. A whole world records it, and a world cut into regions repeats
// it, for tests that compare the two.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"
#include "tests/unit/kinematics2d/region_hub.h"

namespace swarmanoid::kinematics2d
{

inline constexpr double kTick = 0.1;
inline constexpr std::uint32_t kFollowers = 6;

inline CollisionModel Box(double min_x, double min_y, double max_x, double max_y)
{
  const std::array<Vector2, 4> corners{Vector2(max_x, min_y), Vector2(max_x, max_y), Vector2(min_x, max_y),
                                       Vector2(min_x, min_y)};
  return MakeModel({}, {MakePolygon(corners)});
}

struct Scene
{
  double side = 15;  // side of the square around the origin of the plane, m
  double density = 10;
  double speed = 0.3;
  bool has_grips = true;
  bool has_followers = true;
  bool has_large = true;
  bool has_changes = true;  // whether bodies are moved, added and removed
  std::uint64_t seed = 1;

  std::uint32_t Bodies() const { return static_cast<std::uint32_t>(side * side * density); }
  bool IsFootbot(std::uint32_t body) const { return body % 10 != 3 && body % 10 != 7; }
  bool IsPrey(std::uint32_t body) const { return body % 10 == 3; }
  // Only the last follower has this model, whose outline changes from time to time.
  static constexpr std::uint32_t ModelOfLast() { return 4; }
  // Some boxes are too large for the cells.
  bool IsLarge(std::uint32_t body) const { return has_large && body % 400 == 27; }
};

inline Pose2 FollowerPose(const Scene& scene, std::uint32_t k, std::uint64_t tick)
{
  const double angle = 0.004 * static_cast<double>(tick) + k;
  const SinCos at = SinCosOf(angle);
  const double radius = (0.1 + 0.05 * k) * scene.side;
  return {radius * at.cos, radius * at.sin, RotorOf(angle)};
}

// Builds a world with footbots, preys and boxes, followers behind them, and walls around and across. `add` may add
// shapes.
inline KinematicWorld Build(
    const Scene& scene, const std::function<void(KinematicWorld&)>& add = [](KinematicWorld&) {})
{
  KinematicWorld world(0.9);
  const std::uint32_t footbot = world.AddModel(FootbotModel());
  const std::uint32_t prey = world.AddModel(CircleModel(0.08));
  const std::uint32_t box = world.AddModel(RectangleModel(0.16, 0.1));
  const std::uint32_t plank = world.AddModel(RectangleModel(1.2, 0.1));
  const std::uint32_t last = world.AddModel(RectangleModel(0.16, 0.06));
  const std::uint32_t count = scene.Bodies();
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  const double spacing = scene.side / columns;
  const double edge = scene.side / 2;
  RandomStream random(scene.seed, 1, 0, 0);
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const std::uint32_t model = scene.IsLarge(k) ? plank : scene.IsFootbot(k) ? footbot : scene.IsPrey(k) ? prey : box;
    // The numbers of the bodies do not follow their positions.
    const std::uint32_t place = static_cast<std::uint32_t>((std::uint64_t{k} * 7919) % count);
    world.AddBody(model, {(place % columns + 0.5) * spacing - edge, (place / columns + 0.5) * spacing - edge,
                          RotorOf(random.Uniform(-kPi, kPi))});
  }
  if (scene.has_followers)
    for (std::uint32_t k = 0; k < kFollowers; ++k)
      world.AddBody(scene.has_large && k == 2 ? plank
                    : k + 1 == kFollowers     ? last
                                              : prey,
                    FollowerPose(scene, k, 0), true);
  world.AddStatic(Box(-edge - 0.1, -edge - 0.1, -edge, edge + 0.1));
  world.AddStatic(Box(edge, -edge - 0.1, edge + 0.1, edge + 0.1));
  world.AddStatic(Box(-edge - 0.1, -edge - 0.1, edge + 0.1, -edge));
  world.AddStatic(Box(-edge - 0.1, edge, edge + 0.1, edge + 0.1));
  world.AddStatic(Box(-3, -0.1, 3, 0.1));
  world.AddStatic(MakeModel(std::array{Circle{0, 2, 0.4}}, {}));
  add(world);
  world.Start({-edge, -edge, edge, edge});
  return world;
}

struct GripChange
{
  std::uint32_t body;
  std::optional<std::uint32_t> prey;  // nothing: the robot releases its prey
};
struct Jump
{
  std::uint32_t body;
  Pose2 pose;
};
// The events of a tick that do not follow from the numbers of the bodies, and their result in the whole world.
struct Tick
{
  std::vector<GripChange> grips;
  std::vector<Jump> jumps;
  std::vector<Pose2> poses;
  std::vector<double> turrets, travel;
};

// Returns the twist that body `number` is commanded.
inline Twist TwistAt(const Scene& scene, std::uint32_t number, std::uint64_t tick)
{
  RandomStream random(scene.seed, 2, number, tick / 10);
  const double most = number % 97 == 5 ? 4 * scene.speed : scene.speed;
  return {random.Uniform(-0.3 * most, most), 0, random.Uniform(-1, 1)};
}

inline void Command(const Scene& scene, KinematicWorld& world, std::uint32_t body, std::uint64_t tick)
{
  if (!scene.IsFootbot(body)) return;
  world.SetTwist(body, TwistAt(scene, body, tick));
  // Some robots turn only for a while.
  const bool turns = body % 3 == 0 && (tick / 20 + body) % 4 != 0;
  world.SetTurretRate(body, turns ? RandomStream(scene.seed, 3, body, tick / 7).Uniform(-1, 1) : 0);
  if (scene.has_changes && body % 53 == 1) world.SetPresent(body, tick / 11 % 3 != 0);
}

// Applies the events of a tick to the world before it advances.
inline void Act(const Scene& scene, KinematicWorld& world, const Tick& now, std::uint64_t tick)
{
  for (const GripChange& change : now.grips)
    if (change.prey)
      world.AddGrip(change.body, *change.prey);
    else
      world.RemoveGrip(change.body);
  for (const Jump& jump : now.jumps) world.Place(jump.body, jump.pose);
  for (std::uint32_t body = 0; body < scene.Bodies(); ++body) Command(scene, world, body, tick);
  if (!scene.has_followers) return;
  for (std::uint32_t k = 0; k < kFollowers; ++k)
  {
    const std::uint32_t follower = scene.Bodies() + k;
    world.Follow(follower, world.PoseOf(follower), FollowerPose(scene, k, tick), (tick / 40 + k) % 4 != 0);
  }
  // The last body is a box that turns out of the plane, so its outline in the plane grows and shrinks.
  if (tick % 5 == 0)
    world.ReplaceModel(scene.ModelOfLast(), RectangleModel(0.05 + 0.01 * static_cast<double>(tick % 10), 0.06));
}

// Footbots near a prey grip it, and some footbots with a prey release it.
inline std::vector<GripChange> ChooseGrips(const Scene& scene, const KinematicWorld& world, std::uint64_t tick)
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
  std::vector<char> saved;  // before the first recorded tick
  std::uint64_t first = 0;
  WorldStatistics most;
  std::size_t most_grips = 0;
};

// Runs the whole world through `ticks` ticks, after `before` ticks that are not recorded.
inline Story Tell(const Scene& scene, std::uint64_t before, std::uint64_t ticks)
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
    if (scene.has_changes && tick % 16 == 9)
    {
      const auto body = static_cast<std::uint32_t>(8 + tick * 10 % (scene.Bodies() - 20));
      if (world.FindGrip(body) == nullptr && !scene.IsPrey(body))
        now.jumps.push_back({body, {0.4 * scene.side * RandomStream(scene.seed, 4, 0, tick).Uniform(-1, 1), -1, {}}});
    }
    Act(scene, world, now, tick);
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

inline bool SameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// Returns the region of each block at a tick.
using Cuts = std::function<std::vector<std::uint8_t>(std::uint32_t columns, std::uint32_t blocks, std::uint64_t tick)>;

struct Outcome
{
  std::uint64_t differences = 0;  // number of differences between bodies at ticks
  std::string first;              // the first of them
  std::string error;
  std::size_t most_held = 0;
};

inline void CompareTick(const Scene& scene, const KinematicWorld& world, const Tick& told, std::uint64_t tick,
                        Outcome& outcome)
{
  for (std::uint32_t body = 0; body < scene.Bodies(); ++body)
  {
    const Pose2 pose = world.PoseOf(body);
    const Pose2& expected = told.poses[body];
    if (SameBits(pose.x, expected.x) && SameBits(pose.y, expected.y) && SameBits(pose.heading.z, expected.heading.z) &&
        SameBits(pose.heading.w, expected.heading.w) && SameBits(world.TurretAngle(body), told.turrets[body]) &&
        SameBits(world.TravelForward(body) + world.TravelTurn(body), told.travel[body]))
      continue;
    if (outcome.differences++ == 0) outcome.first = "body " + std::to_string(body) + " at tick " + std::to_string(tick);
  }
}

// Runs the same events in a split world, and compares it after each tick. `replaced`: a region that is replaced on the
// way.
inline Outcome Retell(const Scene& scene, const Story& story, unsigned regions, const Cuts& cuts,
                      unsigned halo = PlaneRegion::kHalo,
                      const std::function<std::optional<unsigned>(std::uint64_t tick)>& replaced = nullptr)
{
  Outcome outcome;
  KinematicWorld world = Build(scene);
  world.KeepTravel();
  HubTeam team(regions, halo);
  world.Split(team);
  ByteReader saved(story.saved);
  world.LoadState(saved);
  try
  {
    for (std::uint64_t n = 0; n < story.ticks.size(); ++n)
    {
      const Tick& told = story.ticks[n];
      const std::uint64_t tick = story.first + n;
      const auto other = replaced ? replaced(n) : std::nullopt;
      if (other) team.Replace(*other);
      // The regions are not always ready, so that the world sometimes does without them.
      team.SetReady(!replaced || n % 5 != 4);
      world.MoveCuts(cuts(world.BlockColumns(), world.BlockCount(), n));
      Act(scene, world, told, tick);
      world.Advance(kTick, 1);
      for (unsigned region = 0; region < regions; ++region)
        outcome.most_held = std::max(outcome.most_held, team.Region(region).BodyCount());
      CompareTick(scene, world, told, tick, outcome);
    }
  }
  catch (const std::exception& error)
  {
    outcome.error = error.what();
  }
  return outcome;
}

}  // namespace swarmanoid::kinematics2d
