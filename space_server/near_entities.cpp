// Over a network, a controller host needs only the entities that its robots can sense, and an engine only what others
// changed (EngineNews). A search marks the cells of a grid next to the robots. It includes a margin, and stays good
// until some entity has moved by half of it (as the lists of neighbours of L. Verlet, "Computer experiments on
// classical fluids", Physical Review 159, 1967).
//
// Invariants: the bits of each pose that a receiver needs are those of the space; an entity that enters the
// surroundings is sent whole; positions outside the grid count as in its nearest cell, so none is lost.
#include "space_server/near_entities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Entities within the margin beyond the reach are sent too, so that the search is not repeated at each tick.
constexpr double kMargin_m = 0.5;
constexpr double kRounding_m = 0.01;

// Returns cells over the present positions. An entity that leaves this area counts as in the nearest cell.
PlaneCells<double> CellsOver(const CSwarmanoidSpace& space, const PoseArrays& poses, double reach_m)
{
  double edge = reach_m + kMargin_m + kRounding_m;
  constexpr double kMostCells = 1 << 20;
  double left = std::numeric_limits<double>::infinity(), right = -left;
  double bottom = left, top = right;
  for (const std::uint32_t entity : space.Movable())
  {
    left = std::min(left, poses.x[entity]);
    right = std::max(right, poses.x[entity]);
    bottom = std::min(bottom, poses.y[entity]);
    top = std::max(top, poses.y[entity]);
  }
  if (left > right) left = right = bottom = top = 0;
  edge = CellEdge<2>({right - left, top - bottom}, edge, kMostCells);
  return {left, bottom, right - left, top - bottom, edge, true};
}

// Marks the cells next to a robot: all entities within its reach are in them.
void MarkNear(const PlaneCells<double>& cells, std::span<const std::uint32_t> robots, const PoseArrays& poses,
              std::vector<char>& is_near)
{
  for (const std::uint32_t robot : robots)
  {
    const std::uint32_t middle = cells.CellOf(poses.x[robot], poses.y[robot]);
    for (const std::uint32_t row : {middle - cells.stride, middle, middle + cells.stride})
      for (const std::uint32_t cell : {row - 1, row, row + 1}) is_near[cell] = 1;
  }
}

// Starts the message of the tick, without poses.
void Begin(LocalState& part, const SpaceState& state)
{
  part.tick = state.tick;
  part.last = state.last;
  part.entities.clear();
}

void WritePoses(const PoseArrays& poses, LocalState& part)
{
  part.poses.resize(7 * part.entities.size());
  double* to = part.poses.data();
  for (const auto* component : {&poses.x, &poses.y, &poses.z, &poses.qx, &poses.qy, &poses.qz, &poses.qw})
    for (const std::uint32_t entity : part.entities) *to++ = (*component)[entity];
}

}  // namespace

// No pose has these bits, so all poses have changed at the first call.
SentPoses::SentPoses(const CSwarmanoidSpace& space)
    : space_(space), told_(space.Movable().size(), {std::numeric_limits<double>::quiet_NaN()})
{
}

bool SentPoses::HasChanged(std::size_t movable)
{
  const PoseArrays& poses = space_.Poses();
  const std::uint32_t entity = space_.Movable()[movable];
  const std::array<double, 7> now{poses.x[entity],  poses.y[entity],  poses.z[entity], poses.qx[entity],
                                  poses.qy[entity], poses.qz[entity], poses.qw[entity]};
  // The bits are compared, since minus zero is another pose.
  if (std::memcmp(now.data(), told_[movable].data(), sizeof(now)) == 0) return false;
  told_[movable] = now;
  return true;
}

Surroundings::Surroundings(const CSwarmanoidSpace& space, std::span<const std::uint32_t> robots, double reach_m)
    : space_(space), robots_(robots), cells_(CellsOver(space, space.Poses(), reach_m)), told_poses_(space)
{
  is_near_.resize(cells_.Count());
  is_told_.resize(space.Size(), 1);
  // Floors, lights and similar entities may be large, so they are always sent; they are few.
  for (const std::uint32_t entity : space.Movable())
    is_always_told_.push_back(IsBodiless(space.GetEntity(entity).GetKind()));
  first_slots_.reserve(space.Size() + 1);
  for (std::uint32_t entity = 0; entity < space.Size(); ++entity)
    first_slots_.push_back(space.GetEntity(entity).FirstSlot());
  first_slots_.push_back(space.PresenceSlot(0));
  x_.resize(space.Movable().size());
  y_.resize(space.Movable().size());
}

LocalState& Surroundings::Part(const SpaceState& state)
{
  entered_.clear();
  // A robot that was moved from outside may be tilted for a tick and see beyond the reach of its sensors.
  const bool all = !state.moved.empty();
  if (!holds_ || all || HaveLeftMargin()) Search(all);

  Begin(part_, state);
  const std::span<const std::uint32_t> movable = space_.Movable();
  auto entered = entered_.begin();
  for (std::size_t k = 0; k < movable.size(); ++k)
  {
    if (!IsNear(part_.near, k)) continue;
    // The pose of an entity that enters may have been sent long ago, or to another process.
    const bool is_new = entered != entered_.end() && *entered == movable[k];
    if (is_new) ++entered;
    if (told_poses_.HasChanged(k) || is_new) part_.entities.push_back(movable[k]);
  }
  WritePoses(space_.Poses(), part_);
  AddAttributes(state);
  return part_;
}

bool Surroundings::HaveLeftMargin() const
{
  const PoseArrays& poses = space_.Poses();
  const std::span<const std::uint32_t> movable = space_.Movable();
  double furthest = 0;
  for (std::size_t k = 0; k < movable.size(); ++k)
  {
    const double dx = poses.x[movable[k]] - x_[k];
    const double dy = poses.y[movable[k]] - y_[k];
    furthest = std::max(furthest, dx * dx + dy * dy);
  }
  return furthest > kMargin_m / 2 * kMargin_m / 2;
}

void Surroundings::Search(bool all)
{
  const PoseArrays& poses = space_.Poses();
  const std::span<const std::uint32_t> movable = space_.Movable();
  // A search that sends all entities does not tell which ones will be near at later ticks.
  holds_ = !all;
  std::fill(is_near_.begin(), is_near_.end(), all);
  if (!all) MarkNear(cells_, robots_, poses, is_near_);
  part_.near.assign((movable.size() + 31) / 32, 0);
  for (std::size_t k = 0; k < movable.size(); ++k)
  {
    const std::uint32_t entity = movable[k];
    x_[k] = poses.x[entity];
    y_[k] = poses.y[entity];
    const bool is_near = is_near_[cells_.CellOf(x_[k], y_[k])] != 0 || is_always_told_[k] != 0;
    if (is_near && is_told_[entity] == 0) entered_.push_back(entity);
    is_told_[entity] = is_near;
    if (is_near) part_.near[k / 32] |= 1U << k % 32;
  }
}

void Surroundings::AddAttributes(const SpaceState& state)
{
  AttributeChanges& changes = part_.attributes;
  changes.Clear();
  // Slots ascend, and so do their entities. The slots of presence come last.
  const std::uint32_t first_presence = first_slots_.back();
  std::uint32_t entity = 0;
  for (const std::uint32_t slot : state.attributes.slots)
  {
    while (slot < first_presence && first_slots_[entity + 1] <= slot) ++entity;
    if (is_told_[slot < first_presence ? entity : slot - first_presence] != 0) changes.slots.push_back(slot);
  }
  for (const std::uint32_t other : entered_)
  {
    for (std::uint32_t slot = first_slots_[other]; slot < first_slots_[other + 1]; ++slot)
      changes.slots.push_back(slot);
    changes.slots.push_back(space_.PresenceSlot(other));
  }
  if (!entered_.empty())
  {
    std::sort(changes.slots.begin(), changes.slots.end());
    changes.slots.erase(std::unique(changes.slots.begin(), changes.slots.end()), changes.slots.end());
  }
  for (const std::uint32_t slot : changes.slots) changes.values.push_back(space_.Attributes()[slot]);
}

EngineNews::EngineNews(const CSwarmanoidSpace& space, std::vector<std::uint32_t> owned)
    : space_(space), owned_(std::move(owned)), told_poses_(space)
{
}

LocalState& EngineNews::Part(const SpaceState& state)
{
  Begin(part_, state);
  const std::span<const std::uint32_t> movable = space_.Movable();
  auto own = owned_.begin();
  for (std::size_t k = 0; k < movable.size(); ++k)
  {
    const std::uint32_t entity = movable[k];
    const bool is_own = own != owned_.end() && *own == entity;
    if (is_own) ++own;
    if (is_own ? std::ranges::binary_search(state.moved, entity) : told_poses_.HasChanged(k))
      part_.entities.push_back(entity);
  }
  WritePoses(space_.Poses(), part_);
  part_.attributes = state.attributes;
  part_.moved = state.moved;
  return part_;
}

}  // namespace swarmanoid
