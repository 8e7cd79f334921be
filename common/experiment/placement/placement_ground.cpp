// A terrain answers only for points: whether one is solid, and how high the ground below it is. A body is therefore
// tested at points of horizontal cuts through it, which are at most kSpacing apart unless the body is large. A body may
// stand on the highest ground under any of its points.
//
// Invariant: if no ground is under some point, the body has no ground, so nothing is placed over the edge of a terrain.
#include "common/experiment/placement/placement_ground.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

namespace swarmanoid::placement
{
namespace
{

constexpr double kSpacing = 0.02;   // m, between the tested points of a body
constexpr double kMostPoints = 64;  // along each axis of a large body
constexpr double kInset = 1e-3;     // m: bodies that only touch do not overlap
constexpr double kStep = 0.02;      // m above its plane: height at which a two-dimensional engine cuts the terrain

int PointsAlong(double length) { return static_cast<int>(std::ceil(std::min(length / kSpacing, kMostPoints))); }

// Returns points of a horizontal cut through a body, in its frame. They are at most kSpacing apart unless the body is
// large.
std::vector<Vector2> PointsOfCut(const Body& body)
{
  const double half_x = std::max(body.half.x() - kInset, 0.0);
  const double half_y = std::max(body.half.y() - kInset, 0.0);
  std::vector<Vector2> points;
  if (!body.cylinder)
  {
    const int columns = PointsAlong(2 * half_x) + 1;
    const int rows = PointsAlong(2 * half_y) + 1;
    for (int i = 0; i <= columns; ++i)
      for (int j = 0; j <= rows; ++j)
        points.emplace_back(half_x * (2.0 * i / columns - 1), half_y * (2.0 * j / rows - 1));
    return points;
  }
  points.emplace_back(0, 0);
  const int rings = PointsAlong(half_x);
  for (int ring = 1; ring <= rings; ++ring)
  {
    const double radius = half_x * ring / rings;
    const int count = 2 * PointsAlong(kPi * radius);
    for (int i = 0; i < count; ++i)
    {
      const SinCos angle = SinCosOf(2 * kPi * i / count);
      points.emplace_back(radius * angle.cos, radius * angle.sin);
    }
  }
  return points;
}

// Visits points of the body in the space until `fits` accepts one. Returns whether it did.
template <class Fits>
bool AnyPoint(const Body& body, double low, double high, const Fits& fits)
{
  const int layers = PointsAlong(std::max(high - low, 0.0));
  const std::vector<Vector2> cut = PointsOfCut(body);
  for (int layer = 0; layer <= layers; ++layer)
  {
    const double z = layers == 0 ? low : low + (high - low) * layer / layers;
    for (const Vector2& point : cut)
      if (fits(Vector3(body.centre + body.orientation * Vector3(point.x(), point.y(), z)))) return true;
  }
  return false;
}

}  // namespace

Ground::Ground(Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  const std::size_t count = experiment.entities.size();
  for (std::uint32_t e = 0; e < count; ++e)
  {
    const EntityConfiguration& entity = experiment.entities[e];
    if (DescriptionOf(entity.kind).role != EntityRole::kTerrain || reading.diagnostics.IsLost(kTerrainMap)) continue;
    Placed placed{nullptr, entity.pose, entity.pose.Inverse(), std::vector<bool>(count), std::vector<bool>(count)};
    for (const EngineConfiguration& engine : experiment.engines)
    {
      if (!std::binary_search(engine.entities.begin(), engine.entities.end(), e)) continue;
      const bool is_space = !MovesOnPlane(engine);
      for (const std::uint32_t other : engine.entities)
      {
        placed.is_walked[other] = true;
        if (is_space) placed.is_in_space[other] = true;
      }
    }
    try
    {
      placed.terrain = LoadTerrain(entity, experiment.folder);
      terrains_.push_back(std::move(placed));
    }
    catch (const ConfigurationError& error)
    {
      reading.diagnostics.Add(error.Location(), error.Message());
      reading.diagnostics.Lose(kTerrainMap);
    }
  }
}

std::optional<double> Ground::HighestUnder(std::size_t entity, const Body& body, double from) const
{
  std::optional<double> highest;
  const auto has_no_ground = [&](const Vector3& point)
  {
    std::optional<double> here;
    for (const Placed& placed : terrains_)
    {
      if (!placed.is_walked[entity]) continue;
      const Vector3 local = placed.to_terrain.Apply({point.x(), point.y(), from});
      const auto ground = placed.terrain->GroundBelow(local);
      if (!ground) continue;
      const double height = placed.pose.Apply({local.x(), local.y(), *ground}).z();
      here = std::max(here.value_or(height), height);
    }
    if (here) highest = std::max(highest.value_or(*here), *here);
    return !here;
  };
  if (AnyPoint(body, 0, 0, has_no_ground)) return std::nullopt;
  return highest;
}

bool Ground::IsInRock(std::size_t entity, const Body& body) const
{
  for (const Placed& placed : terrains_)
  {
    if (!placed.is_walked[entity]) continue;
    const double base = -body.half.z();
    const bool is_solid = placed.is_in_space[entity];
    const double low = base + (is_solid ? kInset : std::min(kStep, 2 * body.half.z()));
    const double high = is_solid ? -base - kInset : low;
    if (AnyPoint(body, low, high,
                 [&](const Vector3& point) { return placed.terrain->IsSolid(placed.to_terrain.Apply(point)); }))
      return true;
  }
  return false;
}

}  // namespace swarmanoid::placement
