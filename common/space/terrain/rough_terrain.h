// Makes rough ground with holes, as an OctoMap file: the same file for the same numbers, on every machine. Used by
// `swarmanoid new terrain`.
#pragma once

#include <cstdint>
#include <string>

#include "common/math/pose.h"

namespace swarmanoid
{

struct RoughTerrain
{
  Vector2 size = Vector2(2, 2);  // metres, from the origin
  double resolution = 0.005;     // edge of a cell, metres: the steps that wheels meet
  double roughness = 0.03;       // metres from the lowest ground to the highest
  int holes = 3;                 // round, with vertical walls
  double depth = 0.1;            // of the holes, metres below the lowest ground
  std::uint64_t seed = 1;
};

// Throws std::invalid_argument, with the limit, for numbers that make no terrain, std::runtime_error if the file
// cannot be written.
void WriteRoughTerrain(const std::string& path, const RoughTerrain& terrain);

}  // namespace swarmanoid
