#include "controller_host/devices/sensing/disc_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

enum class Heights
{
  kSpanning,
  kEqual,
  kMixed
};

struct Scene
{
  NearBodies discs;
  SightPoints points;
  Heights heights = Heights::kSpanning;
  float lowest = 0, highest = 0;
  bool at_themselves = false;
};

// Makes crowds and single cylinders, beside each other or overlapping, at the eye and far away.
Scene MakeScene(RandomStream& random, std::size_t count, Heights heights, bool at_themselves)
{
  Scene scene;
  scene.heights = heights;
  scene.at_themselves = at_themselves;
  NearBodies& discs = scene.discs;
  discs.Reserve(count);
  discs.count = count;
  discs.are_alike = heights != Heights::kMixed && random.Below(2) == 0;
  const double radius = random.Uniform(0.02, 0.3);
  const bool on_lattice = random.Below(3) == 0;
  const auto number = [](double value) { return static_cast<float>(value); };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double angle = random.Uniform(-kPi, kPi);
    const double distance = 3.1 * std::sqrt(random.Uniform());
    discs.x[i] = number(on_lattice ? 0.2 * (random.Below(31) - 15.0) : distance * std::cos(angle));
    discs.y[i] = number(on_lattice ? 0.2 * (random.Below(31) - 15.0) : distance * std::sin(angle));
    discs.radius[i] = number(discs.are_alike ? radius : random.Uniform(0.01, 0.2));
    discs.low[i] = number(heights == Heights::kMixed ? random.Uniform(-0.5, 0.3) : -0.1);
    discs.high[i] = number(heights == Heights::kMixed ? discs.low[i] + random.Uniform(0, 0.5) : 0.05);
    discs.entity[i] = static_cast<std::int32_t>(1000 - i);
  }
  SightPoints& points = scene.points;
  points.count = at_themselves ? count : random.Below(150) + 1;
  points.Reserve(points.count);
  for (std::size_t i = 0; i < points.count; ++i)
  {
    const bool is_owned = at_themselves || (count > 0 && random.Below(4) > 0);
    const std::size_t owner = at_themselves ? i : is_owned ? random.Below(static_cast<std::uint32_t>(count)) : 0;
    const auto aside = [&] { return at_themselves ? 0 : number(random.Uniform(-0.1, 0.1)); };
    points.x[i] = is_owned ? discs.x[owner] + aside() : number(random.Uniform(-3, 3));
    points.y[i] = is_owned ? discs.y[owner] + aside() : number(random.Uniform(-3, 3));
    points.z[i] = heights == Heights::kSpanning || random.Below(3) == 0 ? 0 : number(random.Uniform(-0.3, 0.3));
    points.owner[i] = is_owned ? discs.entity[owner] : -1;
    scene.lowest = std::min(scene.lowest, points.z[i]);
    scene.highest = std::max(scene.highest, points.z[i]);
  }
  return scene;
}

// Every cylinder for every point, with the same steps of single precision.
bool IsSeen(const Scene& scene, std::size_t point)
{
  const SightPoints& points = scene.points;
  const NearBodies& discs = scene.discs;
  const float y = points.y[point];
  const float x = points.x[point] * points.x[point] + y * y < 1e-12F ? 1e-6F : points.x[point];
  const float length = std::sqrt(x * x + y * y);
  const float way_x = x / length;
  const float way_y = y / length;
  const float inverse = 1 / (points.z[point] == 0 ? 1e-20F : points.z[point]);
  for (std::size_t i = 0; i < discs.count; ++i)
  {
    if (discs.entity[i] == points.owner[point]) continue;
    if (discs.low[i] > scene.highest || discs.high[i] < scene.lowest) continue;
    float first = 0, last = length;
    if (scene.heights == Heights::kEqual)
    {
      const float a = discs.low[i] * inverse, b = discs.high[i] * inverse;
      first = std::max(std::min(a, b), 0.0F) * length;
      last = std::min(std::max(a, b), 1.0F) * length;
    }
    if (scene.heights == Heights::kMixed)
    {
      const float slope = inverse * length;
      const float a = discs.low[i] * slope, b = discs.high[i] * slope;
      first = std::max(std::min(a, b), 0.0F);
      last = std::min(std::max(a, b), length);
    }
    const float along = discs.x[i] * way_x + discs.y[i] * way_y;
    const float nearest = std::min(std::max(along, first), last);
    const float beside_x = nearest * way_x - discs.x[i];
    const float beside_y = nearest * way_y - discs.y[i];
    if (first <= last && beside_x * beside_x + beside_y * beside_y <= discs.radius[i] * discs.radius[i]) return false;
  }
  return true;
}

// Bytes decide which pairs are tested, and most pairs of a crowd are left out. No bit of the result may change by it.
TEST(DiscField, HidesWhatTestingAllPairsHides)
{
  DiscField field;
  SeenPoints seen;
  std::size_t hidden = 0, all = 0;
  for (std::uint32_t trial = 0; trial < 900; ++trial)
  {
    RandomStream random(trial, 7, 7, 7);
    constexpr std::array<std::size_t, 10> kCounts{1, 7, 9, 31, 40, 56, 57, 80, 250, 500};
    const auto heights = static_cast<Heights>(trial / 10 % 3);
    const std::size_t count =
        std::max<std::size_t>(kCounts[trial % kCounts.size()], heights == Heights::kMixed ? 7 : 0);
    const Scene scene = MakeScene(random, count, heights, trial / 30 % 2 == 0);
    const float reach = trial % 7 == 0 ? 1.0F : 3.1F;
    field.Sort(scene.discs, 0, scene.lowest, scene.highest, reach, scene.at_themselves);
    field.Look(scene.points, seen);
    for (std::size_t i = 0; i < scene.points.count; ++i)
    {
      ASSERT_EQ(seen[i], IsSeen(scene, i)) << "trial " << trial << " count " << count << " point " << i;
      hidden += seen[i] ? 0 : 1;
    }
    all += scene.points.count;
  }
  EXPECT_GT(hidden, all / 4);
  EXPECT_GT(all - hidden, all / 10);
}

}  // namespace
}  // namespace swarmanoid
