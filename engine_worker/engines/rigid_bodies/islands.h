// Islands: sets of numbered things that touch, hold or can meet each other, directly or through others (a union-find).
// OdeWorld solves each delicate island by itself, and ContactGroups finds groups with it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace swarmanoid
{

class Islands
{
public:
  // Puts each of `count` entities into an island of its own.
  void Reset(std::size_t count)
  {
    parents_.resize(count);
    std::iota(parents_.begin(), parents_.end(), 0U);
  }
  void Join(std::uint32_t a, std::uint32_t b)
  {
    const std::uint32_t x = Of(a);
    const std::uint32_t y = Of(b);
    parents_[std::max(x, y)] = std::min(x, y);
  }
  // Returns the island of an entity: the smallest entity in it.
  std::uint32_t Of(std::uint32_t entity)
  {
    while (parents_[entity] != entity) entity = parents_[entity] = parents_[parents_[entity]];
    return entity;
  }

private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace swarmanoid
