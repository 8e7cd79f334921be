// Near pairs without a search in each step: the pairs of a search with a wider margin last until a body has moved by
// half of the difference (a Verlet list, https://doi.org/10.1103/PhysRev.159.98).
//
// Invariant: it gives the same pairs in the same order as a search, so that it changes no bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/math/verlet_lifetime.h"
#include "common/threads/worker_pool.h"
#include "engine_worker/engines/kinematics2d/broad_phase.h"

namespace swarmanoid::kinematics2d
{

class VerletList
{
public:
  // Sets the number of parts (WorkerPool::Parts, or 1) of the pools that Update will get.
  void Configure(unsigned parts) { parts_.resize(parts); }
  // Brings the list up to date, by a search of its own in these blocks if one is needed. Returns false if a list does
  // not pay, or if some bodies are large: then the caller must search for the pairs.
  bool Update(BroadPhase& broad, std::span<const std::uint32_t> blocks, const PoseStore& poses,
              std::span<const std::uint8_t> present, double margin, WorkerPool* pool);
  // The bodies have other numbers now.
  void Forget() { x_.clear(); }
  // Gives, after an Update that returned true, the pairs that BroadPhase::FindPairs finds in these blocks. Several
  // threads may ask for different blocks.
  void TakePairs(std::span<const std::uint32_t> blocks, PairList& found);

private:
  // A pair at its place in the order of a search: the body whose cell comes first, then the other one, each as cell and
  // number. Static shapes come after all bodies of a block, and have no cell.
  struct Near
  {
    std::uint64_t first, second;

    bool operator<(const Near& other) const
    {
      return first != other.first ? first < other.first : second < other.second;
    }
  };
  // The work of one thread.
  struct Part
  {
    std::span<const std::uint32_t> blocks;  // that it searches
    PairList candidates;
    std::vector<Near> near;
    std::vector<std::uint32_t> block_of;  // of each of them
    double furthest = 0;
  };

  bool Holds(const PoseStore& poses, std::span<const std::uint8_t> present, double slack, WorkerPool* pool);
  void Search(BroadPhase& broad, std::span<const std::uint32_t> blocks, const PoseStore& poses,
              std::span<const std::uint8_t> present, WorkerPool* pool);
  void Choose(const BroadPhase& broad, const PoseStore& poses, double margin, WorkerPool* pool);

  // Calls act(part) with all of them, in the threads of the pool if there is one.
  template <class Act>
  void ForEachPart(WorkerPool* pool, const Act& act)
  {
    if (pool != nullptr) return pool->Run(pool->Parts(), [&](unsigned k) { act(parts_[k]); });
    for (Part& part : parts_) act(part);
  }

  std::vector<Part> parts_;
  VerletLifetime lifetime_;
  double margin_ = 0;          // of the search
  std::vector<double> x_, y_;  // of each body then
  std::vector<std::uint8_t> present_;
  std::vector<Near> near_;           // block by block
  std::vector<std::uint32_t> ends_;  // of each block in near_, and 0 before the first
};

}  // namespace swarmanoid::kinematics2d
