// How the worlds of all regions of a plane speak to one another. Implemented by who runs them, used by the kinematic
// world in the thread that advances it.
#pragma once

#include <span>
#include <vector>

#include "common/serialisation/bytes.h"

namespace swarmanoid::kinematics2d
{

class RegionExchange
{
public:
  static constexpr unsigned kMostRegions = 32;

  virtual ~RegionExchange() = default;
  virtual unsigned RegionCount() const = 0;
  // Sends out[k] to region k and fills in[k] with what region k sends in the same call; that of the caller to itself
  // means nothing. Returns when all are here, and throws if a region is gone: what it would have told cannot be made up
  // for, so that all regions then start again from one saved state of the whole world. All call it equally often.
  virtual void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) = 0;
};

}  // namespace swarmanoid::kinematics2d
