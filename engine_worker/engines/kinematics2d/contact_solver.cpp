#include "engine_worker/engines/kinematics2d/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint8_t kMostSweeps = 16;
// A push can wake contacts that were at rest; they are looked for once in so many sweeps.
constexpr std::uint8_t kSweepsPerSearch = 4;
// In large crowds the leaders are not in the cache: they are asked for this many contacts before they are needed.
constexpr std::size_t kAhead = 8;

}  // namespace

void ContactList::Grow(std::size_t contacts)
{
  const std::size_t size = std::max(contacts, 2 * ends_.size());
  ends_.resize(size);
  outlines_.resize(size);
  overlapping_.resize(size);
}

void ContactList::Append(const ContactList& others)
{
  if (count_ + others.count_ > ends_.size()) Grow(count_ + others.count_);
  std::copy_n(others.ends_.begin(), others.count_, ends_.begin() + count_);
  std::copy_n(others.outlines_.begin(), others.count_, outlines_.begin() + count_);
  for (const std::uint32_t contact : others.Overlapping()) overlapping_[overlaps_++] = count_ + contact;
  count_ += others.count_;
}

void ContactSolver::Configure(std::size_t bodies)
{
  contacts_.Grow(2 * bodies + 64);
  pushed_.reserve(bodies + 1);
  last_push_.assign(bodies + 1, 0);
}

void ContactSolver::Clear()
{
  contacts_.Clear();
  for (const PushedLeader& pushed : pushed_) last_push_[pushed.leader] = 0;
  pushed_.clear();
}

inline void ContactSolver::NotePush(std::uint32_t leader, std::uint8_t sweep, double x, double y)
{
  if (last_push_[leader] == 0) pushed_.push_back({leader, x, y});
  last_push_[leader] = sweep;
}

// Whether the contact is deeper than `limit`; if so, how deep and in which direction it pushes.
inline bool ContactSolver::IsDeep(const ContactList::Outline& outline, bool face, double limit, double dx, double dy,
                                  Push& push)
{
  if (face)
  {
    push = {outline.x, outline.y, outline.reach - (dx * outline.x + dy * outline.y)};
    return push.depth > limit;
  }
  const double nx = outline.x + dx;
  const double ny = outline.y + dy;
  const double squared = nx * nx + ny * ny;
  const double near = outline.reach - limit;
  if (!(squared < near * near)) return false;
  const double length = std::sqrt(squared);
  // Two centres at one place: any direction will do.
  push = {length > 0 ? nx / length : 1, length > 0 ? ny / length : 0, outline.reach - length};
  return true;
}

[[gnu::always_inline]] inline void ContactSolver::PushApart(ContactList::Ends ends, const ContactList::Outline& outline,
                                                            std::uint8_t sweep, double limit, const Leaders& leaders)
{
  double* const x = leaders.x;
  double* const y = leaders.y;
  const auto [i, j, face] = ends;
  Push push;
  if (!IsDeep(outline, face != 0, limit, x[i] - x[j], y[i] - y[j], push)) return;
  const double mobility_i = leaders.MobilityOf(i);
  const double mobility_j = leaders.MobilityOf(j);
  const double way = (sweep == 1 ? push.depth + outline.bounce : push.depth) / (mobility_i + mobility_j);
  if (mobility_i > 0)
  {
    NotePush(i, sweep, x[i], y[i]);
    x[i] += push.x * (way * mobility_i);
    y[i] += push.y * (way * mobility_i);
  }
  if (mobility_j > 0)
  {
    NotePush(j, sweep, x[j], y[j]);
    x[j] -= push.x * (way * mobility_j);
    y[j] -= push.y * (way * mobility_j);
  }
}

inline void ContactSolver::Prefetch(std::uint32_t contact, const Leaders& leaders) const
{
  const auto [i, j, face] = contacts_.AllEnds()[contact];
  __builtin_prefetch(&leaders.x[i]);
  __builtin_prefetch(&leaders.y[i]);
  __builtin_prefetch(&leaders.x[j]);
  __builtin_prefetch(&leaders.y[j]);
}

// All contacts of leaders that were pushed since the last search.
void ContactSolver::ActivateNeighbours(std::uint8_t sweep)
{
  const int since = std::max(1, sweep - kSweepsPerSearch);
  last_search_ = sweep;
  const std::span<const ContactList::Ends> ends = contacts_.AllEnds();
  active_.resize(std::max(active_.size(), ends.size()));
  std::uint32_t* const active = active_.data();
  std::size_t found = 0;
  for (std::uint32_t index = 0; index < ends.size(); ++index)
  {
    active[found] = index;
    found += IsPushedSince(ends[index].first, ends[index].second, since) ? 1 : 0;
  }
  active_count_ = found;
}

void ContactSolver::Solve(std::span<const double> mobility, double tolerance, double reach, std::vector<double>& x,
                          std::vector<double>& y)
{
  const Leaders leaders{mobility.data(), x.data(), y.data(), static_cast<std::uint32_t>(last_push_.size() - 1)};
  last_search_ = 0;
  const std::span<const std::uint32_t> overlapping = contacts_.Overlapping();
  const ContactList::Ends* const ends = contacts_.AllEnds().data();
  const ContactList::Outline* const outlines = contacts_.Outlines().data();
  for (std::size_t n = 0; n < overlapping.size(); ++n)
  {
    if (n + kAhead < overlapping.size()) Prefetch(overlapping[n + kAhead], leaders);
    const std::uint32_t contact = overlapping[n];
    PushApart(ends[contact], outlines[contact], 1, 0, leaders);
  }
  for (std::uint8_t sweep = 2; sweep <= kMostSweeps; ++sweep)
  {
    const bool search = (sweep - 2) % kSweepsPerSearch == 0;
    if (search)
    {
      ActivateNeighbours(sweep);
      if (active_count_ == 0) break;
    }
    // A contact stays active as long as one of its leaders moves.
    std::size_t kept = 0;
    const std::size_t count = active_count_;
    std::uint32_t* const active = active_.data();
    for (std::size_t n = 0; n < count; ++n)
    {
      if (search && n + kAhead < count) Prefetch(active[n + kAhead], leaders);
      const std::uint32_t contact = active[n];
      const auto [i, j, face] = ends[contact];
      if (!search && !IsPushedSince(i, j, sweep - 1)) continue;
      PushApart(ends[contact], outlines[contact], sweep, tolerance, leaders);
      active[kept] = contact;
      kept += IsPushedSince(i, j, sweep - 1) ? 1 : 0;
    }
    active_count_ = kept;
  }

  for (const PushedLeader& pushed : pushed_)
  {
    const double dx = x[pushed.leader] - pushed.x;
    const double dy = y[pushed.leader] - pushed.y;
    const double squared = dx * dx + dy * dy;
    if (squared <= reach * reach) continue;
    const double scale = reach / std::sqrt(squared);
    x[pushed.leader] = pushed.x + dx * scale;
    y[pushed.leader] = pushed.y + dy * scale;
    last_push_[pushed.leader] = kMostSweeps;
  }
}

}  // namespace swarmanoid::kinematics2d
