#pragma once

#include <vector>

namespace swarmanoid
{

// Global poses of all entities, one array a component, in entity order.
struct PoseArrays
{
  std::vector<double> x, y, z;
  std::vector<double> qx, qy, qz, qw;
};

}  // namespace swarmanoid
