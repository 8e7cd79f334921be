// LEDs are drawn at the positions of the kind's row, and turned with a turret.
#include "visualiser/led_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/visualiser/small_world.h"

namespace swarmanoid
{
namespace
{

TEST(LedPlace, IsThatOfTheRow)
{
  SmallWorld world({4, 4, 3});
  world.Add(EntityKind::kEyebot, "eb", {1, 1, 1}, 90);
  world.Add(EntityKind::kFootbot, "fb", {2, 2, 0}, 90);
  for (const char* id : {"eb", "fb"})
  {
    const LedLayout& leds = *DescriptionOf(world[id].GetKind()).leds;
    for (std::size_t led = 0; led < leds.places.size(); ++led)
      EXPECT_EQ(LedPlace(world[id], led), Vector3(leds.places[led].x(), leds.places[led].y(), leds.height_m)) << id;
  }
}

TEST(LedPlace, TurnsWithTheTurret)
{
  SmallWorld world({4, 4, 3});
  world.Add(EntityKind::kFootbot, "fb", {2, 2, 0}, 45);
  const Vector3 ahead = LedPlace(world["fb"], 0);
  world.Set("fb", "turret_angle", kPi / 2);
  EXPECT_TRUE(LedPlace(world["fb"], 0).isApprox(Vector3(-ahead.y(), ahead.x(), ahead.z()), 1e-12));
}

}  // namespace
}  // namespace swarmanoid
