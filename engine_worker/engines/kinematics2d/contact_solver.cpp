// Problem: contacts of a crowd depend on each other, since parting one pair pushes others together.
//
// Method: Gauss-Seidel. Each contact in turn parts its leaders by the overlap that they have now, shared by mobility.
// In its first visit, a contact that overlapped also gives the approach back. Contacts come in blocks of cells, and the
// blocks have four colours. The colours take turns; a visit sweeps up to kMostSweeps times over the contacts of a
// block whose leaders moved. A stamp on each leader says when it was pushed last, so that resting contacts cost little.
//
// Friction: a static shape that pushes a leader away by w takes up to friction * w from the way that the leader made
// along the shape, and never more than all of it. The pushes of a body that drives against a wall at an angle a add up
// to the way v sin(a) into it, so it slides at v (cos a - friction * sin a), as a body whose drive has a limited force.
//
// Invariants: blocks of one colour share no leader, so threads may take them in any order. Inside a block contacts have
// the order in which they were added. Equal and opposite pushes keep the weighted sum of all ways.
// Source: M. F. Adams, A distributed memory unstructured Gauss-Seidel algorithm for multigrid smoothers, SC 2001;
// docs/engines.md, "Crowds: how".
#include "engine_worker/engines/kinematics2d/contact_solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine_worker/engines/kinematics2d/motion.h"

namespace swarmanoid::kinematics2d
{
namespace
{

// Each round visits every block once, colour after colour, so that a block sees what others did to its border. In
// crowds two rounds leave much of the work undone, and more than four help little.
constexpr unsigned kRounds = 4;
constexpr unsigned kMostSweeps = 16;  // of a visit
// A push can wake contacts that were at rest; they are looked for once in so many sweeps.
constexpr unsigned kSweepsPerSearch = 4;
// In large crowds the leaders are not in the cache: they are asked for this many contacts before they are needed.
constexpr std::uint32_t kAhead = 8;
// Fewer contacts of a colour are not worth waking threads.
constexpr std::uint32_t kLeastShared = 128;

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

void ContactSolver::Configure(std::size_t bodies, unsigned threads)
{
  statics_ = static_cast<std::uint32_t>(bodies);
  last_push_.assign(PaddedCount(bodies + 1), 0);
  active_.resize(threads);
}

// Returns whether the contact is deeper than `limit`; if so, sets how deep it is and in which direction it pushes.
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
  // Two centres at one place are pushed apart along x; any direction will do.
  push = {length > 0 ? nx / length : 1, length > 0 ? ny / length : 0, outline.reach - length};
  return true;
}

[[gnu::always_inline]] inline bool ContactSolver::PushApart(ContactList::Ends ends, const ContactList::Outline& outline,
                                                            Stamp now, double limit, bool bounces,
                                                            const Leaders& leaders)
{
  double* const x = leaders.x;
  double* const y = leaders.y;
  const auto [i, j, face] = ends;
  Push push;
  if (!IsDeep(outline, face != 0, limit, x[i] - x[j], y[i] - y[j], push)) return false;
  const double mobility_i = leaders.MobilityOf(i);
  const double mobility_j = leaders.MobilityOf(j);
  const double depth = std::min(push.depth, leaders.most);
  const double way = (bounces ? depth + outline.bounce : depth) / (mobility_i + mobility_j);
  if (mobility_i > 0)
  {
    leaders.last_push[i] = now;
    x[i] += push.x * (way * mobility_i);
    y[i] += push.y * (way * mobility_i);
    if (outline.friction > 0) Rub(i, push, outline.friction * way * mobility_i, leaders);
  }
  if (mobility_j > 0)
  {
    leaders.last_push[j] = now;
    x[j] -= push.x * (way * mobility_j);
    y[j] -= push.y * (way * mobility_j);
  }
  return true;
}

// Takes up to `most` (m) from the way that a leader made across a push.
void ContactSolver::Rub(std::uint32_t leader, const Push& push, double most, const Leaders& leaders)
{
  double& x = leaders.x[leader];
  double& y = leaders.y[leader];
  const double across = push.x * (y - leaders.before_y[leader]) - push.y * (x - leaders.before_x[leader]);
  const double lost = std::clamp(across, -most, most);
  x += push.y * lost;
  y -= push.x * lost;
}

inline void ContactSolver::Prefetch(ContactList::Ends ends, const Leaders& leaders)
{
  __builtin_prefetch(&leaders.x[ends.first]);
  __builtin_prefetch(&leaders.y[ends.first]);
  __builtin_prefetch(&leaders.x[ends.second]);
  __builtin_prefetch(&leaders.y[ends.second]);
}

// Pushes from the stamp `since` on are news to the block. It is 0 in the first visit, in which overlaps bounce. Returns
// whether a leader moved.
bool ContactSolver::Visit(const ContactBlock& block, Stamp begin, Stamp since, double tolerance, const Leaders& leaders,
                          std::vector<std::uint32_t>& active)
{
  const ContactList::Ends* const ends = block.list->AllEnds().data();
  const ContactList::Outline* const outlines = block.list->Outlines().data();
  const std::span<const std::uint32_t> overlapping =
      block.list->Overlapping().subspan(block.first_overlapping, block.last_overlapping - block.first_overlapping);
  bool moved = false;
  if (since == 0)
  {
    for (std::size_t n = 0; n < overlapping.size(); ++n)
    {
      if (n + kAhead < overlapping.size()) Prefetch(ends[overlapping[n + kAhead]], leaders);
      const std::uint32_t contact = overlapping[n];
      moved |= PushApart(ends[contact], outlines[contact], begin, 0, true, leaders);
    }
    since = 1;
  }
  std::size_t count = 0;
  for (unsigned sweep = 1; sweep < kMostSweeps; ++sweep)
  {
    const auto now = static_cast<Stamp>(begin + sweep);
    // A contact stays active as long as one of its leaders moves.
    const bool search = (sweep - 1) % kSweepsPerSearch == 0;
    if (search)
    {
      const auto from = sweep == 1 ? since : static_cast<Stamp>(now - kSweepsPerSearch);
      active.resize(std::max<std::size_t>(active.size(), block.last - block.first));
      count = 0;
      for (std::uint32_t contact = block.first; contact < block.last; ++contact)
      {
        active[count] = contact;
        count += leaders.IsPushedSince(ends[contact], from) ? 1 : 0;
      }
    }
    if (count == 0) break;
    std::size_t kept = 0;
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::uint32_t contact = active[n];
      if (!search && !leaders.IsPushedSince(ends[contact], static_cast<Stamp>(now - 1))) continue;
      moved |= PushApart(ends[contact], outlines[contact], now, tolerance, false, leaders);
      active[kept] = contact;
      kept += leaders.IsPushedSince(ends[contact], static_cast<Stamp>(now - 1)) ? 1 : 0;
    }
    count = kept;
  }
  return moved;
}

void ContactSolver::Solve(std::span<const std::vector<ContactBlock>> colours, std::span<const double> mobility,
                          double tolerance, double most, PoseStore& now, const PoseStore& before, WorkerPool* pool,
                          Border* border)
{
  const Leaders own{mobility.data(), now.x.data(),      now.y.data(), before.x.data(),
                    before.y.data(), last_push_.data(), statics_,     most};
  std::fill(last_push_.begin(), last_push_.end(), Stamp{0});
  const auto stride = static_cast<unsigned>(colours.size()) * kMostSweeps;
  for (unsigned round = 0; round < kRounds; ++round)
  {
    std::atomic<bool> moved = false;  // in this region, then in any
    for (unsigned colour = 0; colour < colours.size(); ++colour)
    {
      const std::vector<ContactBlock>& blocks = colours[colour];
      const bool is_shared = border != nullptr && colour + 1 == colours.size();
      const Leaders leaders = is_shared ? border->TakeShared(most) : own;
      const unsigned begin = 1 + round * stride + colour * kMostSweeps;
      // Its own last sweep may have left something to do.
      const unsigned since = round == 0 ? 0 : begin - stride + kMostSweeps - 1;
      const auto visit = [&](const ContactBlock& block, unsigned thread)
      {
        if (Visit(block, static_cast<Stamp>(begin), static_cast<Stamp>(since), tolerance, leaders, active_[thread]))
          moved.store(true, std::memory_order_relaxed);
      };
      std::uint32_t contacts = 0;
      for (const ContactBlock& block : blocks) contacts += block.last - block.first;
      if (pool == nullptr || blocks.size() < 2 || contacts < kLeastShared)
        for (const ContactBlock& block : blocks) visit(block, 0);
      else
        OneByOne(*pool, blocks.size(), [&](std::size_t n, unsigned thread) { visit(blocks[n], thread); });
      if (is_shared)
        border->PutShared(static_cast<Stamp>(begin));
      else if (border != nullptr)
        moved = border->AfterColour(static_cast<Stamp>(begin), moved);
    }
    if (!moved) break;
  }
}

}  // namespace swarmanoid::kinematics2d
