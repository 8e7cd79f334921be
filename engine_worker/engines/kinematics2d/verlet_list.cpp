// Problem: in a crowd that moves little, the same pairs are searched for in each step.
//
// Method: a search with the largest margin finds candidates. Each step keeps the candidates that are within the margin
// of the step. The list lasts until a body has moved by half of the difference of the margins. A counting sort puts the
// pairs into blocks, and an insertion sort into the order of a search within a block.
//
// Invariant: counts of steps alone decide whether a list pays (VerletLifetime), not a clock.
#include "engine_worker/engines/kinematics2d/verlet_list.h"

#include <algorithm>
#include <numeric>

#include "common/math/lanes.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint64_t kStatic = std::uint64_t{1} << 63;

// Sorts in place. Nearly all values are in order already, which makes insertion quick.
template <class Value>
void InsertionSort(std::span<Value> values)
{
  for (std::size_t k = 1; k < values.size(); ++k)
  {
    if (!(values[k] < values[k - 1])) continue;
    const Value value = values[k];
    std::size_t at = k;
    for (; at > 0 && value < values[at - 1]; --at) values[at] = values[at - 1];
    values[at] = value;
  }
}

}  // namespace

bool VerletList::Update(BroadPhase& broad, std::span<const std::uint32_t> blocks, const PoseStore& poses,
                        std::span<const std::uint8_t> present, double margin, WorkerPool* pool)
{
  if (!broad.Large().empty() || margin > broad.LargestMargin()) return false;
  if (!lifetime_.BeginStep()) return false;
  if (!lifetime_.HasList() || !Holds(poses, present, margin_ - margin - 4 * broad.Rounding(), pool))
  {
    if (!lifetime_.Renew()) return false;
    Search(broad, blocks, poses, present, pool);
  }
  Choose(broad, poses, margin, pool);
  return true;
}

// Returns whether no body has moved further than half of `slack` (m), appeared or gone.
bool VerletList::Holds(const PoseStore& poses, std::span<const std::uint8_t> present, double slack, WorkerPool* pool)
{
  if (slack < 0 || x_.size() != poses.x.size() || !std::ranges::equal(present_, present)) return false;
  const auto furthest_square = [&](std::size_t begin, std::size_t end)
  {
    DoubleLanes squares{};
    for (std::size_t k = begin; k < end; k += kDoubleLanes)
    {
      const DoubleLanes dx = LoadLanes(&poses.x[k]) - LoadLanes(&x_[k]);
      const DoubleLanes dy = LoadLanes(&poses.y[k]) - LoadLanes(&y_[k]);
      squares = Maximum(dx * dx + dy * dy, squares);
    }
    double furthest = 0;
    for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) furthest = std::max(furthest, squares[lane]);
    return furthest;
  };
  for (Part& part : parts_) part.furthest = 0;
  InParts(pool, x_.size(), kPadding,
          [&](unsigned part, std::size_t begin, std::size_t end)
          { parts_[part].furthest = furthest_square(begin, end); });
  return std::ranges::max(parts_, {}, &Part::furthest).furthest <= slack * slack / 4;
}

void VerletList::Search(BroadPhase& broad, std::span<const std::uint32_t> blocks, const PoseStore& poses,
                        std::span<const std::uint8_t> present, WorkerPool* pool)
{
  broad.Sort(poses, present, pool);
  x_ = poses.x;
  y_ = poses.y;
  present_.assign(present.begin(), present.end());
  margin_ = broad.LargestMargin();
  broad.ShareOut(blocks, parts_.size(), parts_);
  ForEachPart(pool, [&](Part& part) { broad.FindPairs(margin_, part.blocks, part.candidates); });
}

void VerletList::Choose(const BroadPhase& broad, const PoseStore& poses, double margin, WorkerPool* pool)
{
  const float reach = broad.ReachOf(margin);
  const auto key = [](std::uint32_t cell, std::uint32_t body) { return std::uint64_t{cell} << 32 | body; };
  ForEachPart(pool,
              [&](Part& part)
              {
                part.near.clear();
                part.block_of.clear();
                for (const auto& [a, b] : part.candidates.pairs)
                {
                  if (!broad.IsNear({a, b}, reach, poses)) continue;
                  const BroadPhase::Place at = broad.PlaceOf(poses.x[a], poses.y[a]);
                  if (b >= present_.size())
                  {
                    part.near.push_back({kStatic | key(at.cell, a), b});
                    part.block_of.push_back(at.block);
                    continue;
                  }
                  const BroadPhase::Place other = broad.PlaceOf(poses.x[b], poses.y[b]);
                  const std::uint64_t one = key(at.cell, a);
                  const std::uint64_t two = key(other.cell, b);
                  part.near.push_back({std::min(one, two), std::max(one, two)});
                  part.block_of.push_back(one < two ? at.block : other.block);
                }
              });

  // Sorts by block. The counts are two places up, as in CellSort.
  ends_.assign(broad.BlockCount() + 2, 0);
  std::size_t count = 0;
  for (const Part& part : parts_)
  {
    for (const std::uint32_t block : part.block_of) ++ends_[block + 2];
    count += part.near.size();
  }
  std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
  near_.resize(count);
  for (const Part& part : parts_)
    for (std::size_t n = 0; n < part.near.size(); ++n) near_[ends_[part.block_of[n] + 1]++] = part.near[n];
}

void VerletList::TakePairs(std::span<const std::uint32_t> blocks, PairList& found)
{
  found.pairs.clear();
  found.ends.clear();
  for (const std::uint32_t block : blocks)
  {
    const std::span<Near> near(near_.data() + ends_[block], ends_[block + 1] - ends_[block]);
    InsertionSort(near);
    for (const Near& pair : near)
    {
      const auto a = static_cast<std::uint32_t>(pair.first);
      const auto b = static_cast<std::uint32_t>(pair.second);
      found.pairs.push_back({std::min(a, b), std::max(a, b)});
    }
    found.ends.push_back(static_cast<std::uint32_t>(found.pairs.size()));
  }
}

}  // namespace swarmanoid::kinematics2d
