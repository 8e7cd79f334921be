// Makes rough ground with holes, as an OctoMap file. Equal numbers give the same file on every machine. `swarmanoid new
// terrain` uses it.
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
  int holes = 3;                 // number of holes, which are round, with vertical walls
  double depth = 0.1;            // depth of the holes in metres below the lowest ground
  std::uint64_t seed = 1;
};

// Writes the file. Throws std::invalid_argument, with the limit, for numbers that make no terrain, and
// std::runtime_error if the file cannot be written.
void WriteRoughTerrain(const std::string& path, const RoughTerrain& terrain);

}  // namespace swarmanoid
