#include "visualiser/scene/led_ring.h"

#include <numbers>

namespace swarmanoid
{

void AddLedRing(MeshBuilder& builder, const LedRing& ring, int pieces)
{
  const float spacing = 2 * std::numbers::pi_v<float> / static_cast<float>(ring.leds);
  const float half = 0.5F * ring.lit * spacing;
  for (int led = 0; led < ring.leds; ++led)
  {
    const float middle = ring.first_angle + static_cast<float>(led) * spacing;
    const Material material = LedMaterial(led);
    builder.Band({ring.radius, ring.low, material}, {ring.radius, ring.high, material}, middle - half, middle + half,
                 pieces);
    if (ring.lit < 1)
      builder.Band({ring.radius - 0.001F, ring.low, Material::kShell}, {ring.radius - 0.001F, ring.high}, middle + half,
                   middle + spacing - half, 1);
  }
}

}  // namespace swarmanoid
