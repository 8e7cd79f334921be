// A ring of LED windows about the z axis, for the meshes of robots.
#pragma once

#include "visualiser/scene/mesh_builder.h"

namespace swarmanoid
{

struct LedRing
{
  int leds;
  float first_angle;  // rad, to the middle of LED 0
  float radius;
  float low, high;  // z
  float lit;        // the fraction of the circle that shines
};

// Adds a ring of LEDs. `pieces` is the number of flat pieces of each window.
void AddLedRing(MeshBuilder& builder, const LedRing& ring, int pieces);

}  // namespace swarmanoid
