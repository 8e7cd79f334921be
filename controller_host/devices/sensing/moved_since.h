// MovedSince: how far the movable bodies have gone since the reference tick, at which neighbours were searched. While
// no body has gone farther than half a margin, all neighbours are among those found within that margin (Verlet,
// "Computer experiments on classical fluids", Physical Review 159, 1967). Used by sensors that look for the same
// neighbours tick after tick.
#pragma once

#include <cstdint>
#include <vector>

#include "common/math/verlet_lifetime.h"
#include "common/space/space.h"
#include "common/threads/worker_pool.h"

namespace swarmanoid
{

class MovedSince
{
public:
  static constexpr double kMostMargin = 0.12;  // m

  // `bodies` are entities, ascending; they outlive this object.
  MovedSince(const CSwarmanoidSpace& space, std::span<const std::uint32_t> bodies) : space_(space), bodies_(bodies) {}

  // Looks at the poses of the space, once for each of its revisions; in the threads of `pool`, if there is one.
  void Follow(WorkerPool* pool);
  // Returns true if neighbours may be taken from a search at the reference tick. All bodies must be upright, and so
  // slow that it pays.
  bool Holds() const { return lifetime_.HasList(); }
  // Returns whether the reference tick is the present tick.
  bool IsNow() const { return is_now_; }
  // Returns a number of the reference tick, which differs from all earlier ones.
  std::uint64_t Number() const { return number_; }
  // Two bodies have come nearer to each other by at most this since then, and to what stands by half of it, m.
  double Margin() const { return margin_; }

private:
  // Returns the square of the furthest way, or infinity if a body is not upright.
  double FurthestSquare(std::size_t begin, std::size_t end) const;
  void Begin();

  const CSwarmanoidSpace& space_;
  std::span<const std::uint32_t> bodies_;
  std::uint64_t revision_ = 0;  // of the space; none has it
  std::uint64_t number_ = 0;
  VerletLifetime lifetime_;
  bool is_now_ = false;
  double margin_ = 0;
  std::vector<double> x_, y_;  // of each body then
  std::vector<std::uint32_t> absent_;
  std::vector<double> furthest_;  // of each part
};

}  // namespace swarmanoid
