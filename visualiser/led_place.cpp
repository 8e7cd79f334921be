#include "visualiser/led_place.h"

#include "common/experiment/entity_kind.h"

namespace swarmanoid
{

Vector3 LedPlace(const CSwarmanoidSpaceEntity& robot, std::size_t led)
{
  const LedLayout& leds = *DescriptionOf(robot.GetKind()).leds;
  const Vector3 place(leds.places[led].x(), leds.places[led].y(), leds.height_m);
  return leds.on_turret ? QuaternionFromYaw(robot.GetAttribute("turret_angle")) * place : place;
}

}  // namespace swarmanoid
