#pragma once

#include <vector>

namespace swarmanoid
{

// The arrays have the global poses of all entities in entity order, one array for each component.
struct PoseArrays
{
  std::vector<double> x, y, z;
  std::vector<double> qx, qy, qz, qw;
};

}  // namespace swarmanoid
