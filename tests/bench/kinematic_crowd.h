// The crowd of the benchmarks of the kinematic engine: footbots that wander in a walled square.
#pragma once

#include <array>
#include <cmath>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{

inline constexpr double kTick = 0.1;

inline CollisionModel Box(double min_x, double min_y, double max_x, double max_y)
{
  const std::array<Vector2, 4> corners{Vector2(max_x, min_y), Vector2(max_x, max_y), Vector2(min_x, max_y),
                                       Vector2(min_x, min_y)};
  return MakeModel({}, {MakePolygon(corners)});
}

inline KinematicWorld Crowd(std::uint32_t count, double density, unsigned threads)
{
  KinematicWorld world;
  const auto footbot = world.AddModel(FootbotModel());
  const double side = std::sqrt(count / density);
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  const double spacing = side / columns;
  RandomStream random(1, 0, 0, 0);
  for (std::uint32_t k = 0; k < count; ++k)
    world.AddBody(footbot,
                  {(k % columns + 0.5) * spacing, (k / columns + 0.5) * spacing, RotorOf(random.Uniform(-kPi, kPi))});
  world.AddStatic(Box(-0.1, -0.1, 0, side + 0.1));
  world.AddStatic(Box(side, -0.1, side + 0.1, side + 0.1));
  world.AddStatic(Box(-0.1, -0.1, side + 0.1, 0));
  world.AddStatic(Box(-0.1, side, side + 0.1, side + 0.1));
  world.Start({0, 0, side, side}, threads);
  return world;
}

// Sets new speeds for a twentieth of the robots, forward as often as back. A crowd that only drives forward would jam
// along the walls, since it does not avoid them.
template <class SetTwist>
void SteerEach(std::uint32_t count, std::uint32_t tick, const SetTwist& set_twist)
{
  RandomStream random(2, 0, 0, tick);
  for (std::uint32_t k = tick % 20; k < count; k += 20)
    set_twist(k, Twist{random.Uniform(-0.2, 0.2), 0, random.Uniform(-1, 1)});
}

}  // namespace swarmanoid::kinematics2d
