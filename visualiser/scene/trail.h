// The trail of an entity: its last positions, a few centimetres apart.
#pragma once

#include <array>

#include "visualiser/scene/scene.h"

namespace swarmanoid
{

struct Scene::Trail
{
  static constexpr std::size_t kPlaces = 160;
  static constexpr float kStep = 0.03F;  // m between two positions

  std::array<Eigen::Vector3f, kPlaces> places;
  std::size_t next = 0;
  std::size_t count = 0;

  void Add(const Eigen::Vector3f& place)
  {
    if (count > 0 && (place - Last(0)).squaredNorm() < kStep * kStep) return;
    places[next] = place;
    next = (next + 1) % kPlaces;
    if (count < kPlaces) ++count;
  }
  // Returns a position; 0 is the newest.
  const Eigen::Vector3f& Last(std::size_t back) const { return places[(next + 2 * kPlaces - 1 - back) % kPlaces]; }
};

}  // namespace swarmanoid
