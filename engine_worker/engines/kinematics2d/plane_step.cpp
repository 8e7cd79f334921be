// Problem: move all bodies of a plane through a tick as they are told, so that no outlines overlap.
//
// Method: the tick is cut into substeps that are short enough for the fastest body. In each, all bodies move freely;
// contacts of near outlines are found and solved, which only says where bodies want to go; and where that leaves
// overlaps, motions are limited from where the substep began. A region of a cut plane does the same for the bodies in
// its blocks, and exchanges with the other regions at the named places.
//
// Source: docs/engines.md, "Model"; docs/scaling.md for regions.
#include "engine_worker/engines/kinematics2d/plane_step.h"

#include "engine_worker/engines/kinematics2d/region_border.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{
namespace
{

void SolveContacts(PlaneState& plane, ContactSolver::Border* border)
{
  const std::span<const double> mobility =
      plane.EachIsFree() ? std::span<const double>() : std::span<const double>(plane.groups.mobility);
  plane.contacts.solver.Solve(plane.contacts.colours, mobility, kSolverTolerance * plane.lengths.allowed,
                              2 * plane.lengths.reach, plane.bodies.now, plane.bodies.before, plane.Pool(), border);
}

void Substep(PlaneState& plane, double seconds, double fraction, Region* region)
{
  Bodies& bodies = plane.bodies;
  plane.limits.limiter.Clear();
  MoveBodies(plane, seconds, fraction);

  bodies.SwapFollowers();
  FindNearPairs(plane, region != nullptr ? region->bodies.HeldBlocks() : plane.contacts.broad.Blocks());
  if (region != nullptr) region->border.ChoosePairsOfLarge();
  bodies.SwapFollowers();
  FindContacts(plane);
  if (region != nullptr) region->border.ShareContacts();
  bool overlap = SortContactsByColour(plane.contacts);
  if (region != nullptr) overlap = region->border.OverlapsAnywhere();

  if (overlap)
  {
    SolveContacts(plane, region != nullptr ? &region->border : nullptr);
    LimitPushes(plane, seconds);
    bool more = FindOverlaps(plane);
    if (region != nullptr) more = region->border.ShareInvolved(more);
    if (more)
    {
      bodies.SwapFollowers();
      BeginLimits(plane, seconds);
      for (bool is_first = true; more; is_first = false)
      {
        more = AddLimits(plane, seconds, is_first);
        if (region != nullptr && !more) more = region->border.ShareInvolved(false);
      }
      LimitMotions(plane, seconds, region != nullptr ? &region->border.ShareLimits() : nullptr);
    }
  }
  if (bodies.keeps_travel) MeasureTravel(plane, seconds);
}

Bounds BoxOf(const CollisionModel& model)
{
  Bounds box{1e300, 1e300, -1e300, -1e300};
  for (int k = 0; k < model.circles; ++k) box.Include(model.part_x[k], model.part_y[k], model.part_radius[k]);
  for (const Polygon& polygon : model.polygons)
    for (int k = 0; k < polygon.count; ++k) box.Include(polygon.x[k], polygon.y[k], 0);
  return box;
}

}  // namespace

void PlaneState::Start(const PlaneGrid& grid, unsigned thread_count, WorkerPool* shared_pool)
{
  threads = thread_count;
  if (shared_pool == nullptr && threads > 1) own_pool = std::make_unique<WorkerPool>(threads);
  pool = shared_pool != nullptr ? shared_pool : own_pool.get();
  lengths.allowed = kAllowedOverlap * bodies.smallest_limit / kWayInCore;

  bodies.MakeRoom();
  for (std::uint32_t k = 0; k < bodies.count; ++k) bodies.inverse_limit[k] = 1 / bodies.LimitOf(bodies.ModelOf(k));
  bodies.turrets.reserve(bodies.count);

  BroadPhase& broad = contacts.broad;
  broad.Configure(grid, bodies.Radii());
  std::vector<Bounds> boxes;
  for (const CollisionModel& shape : bodies.statics) boxes.push_back(BoxOf(shape));
  broad.SetStatics(boxes);
  contacts.blocks.assign(broad.Blocks().begin(), broad.Blocks().end());
  contacts.of_blocks.resize(contacts.blocks.size());
  contacts.parts.resize(PartCount() + 1);
  contacts.verlet_list.Configure(PartCount());
  limits.parts.resize(PartCount() + 1);
  limits.limiter.Configure(bodies.count + 1);
  BodiesChanged();
  groups.grips.reserve(bodies.count);
  groups.starts.reserve(bodies.count + 1);
}

void PlaneState::BodiesChanged()
{
  groups.grips.clear();
  groups.Rebuild(bodies);
  limits.way.resize(PaddedCount(bodies.count));
  Trim(groups.leader);
  Trim(groups.mobility);
  Trim(limits.way);
  limits.is_involved.resize(bodies.count + 1);
  limits.limiter.Clear();
  limits.limiter.MakeRoom(bodies.count + 1);
  contacts.solver.Configure(bodies.count, threads);
}

void Advance(PlaneState& plane, double seconds, int steps, Region* region)
{
  if (region != nullptr) region->bodies.Share();
  Bodies& bodies = plane.bodies;
  if (bodies.keeps_travel)
    for (ZeroedVector<double>* travel : {&bodies.travel_forward, &bodies.travel_turn})
      std::fill(travel->begin(), travel->end(), 0.0);
  FindGroupTwists(bodies, plane.groups);
  LongestWay longest = FindLongestWay(bodies, plane.groups, seconds);
  if (region != nullptr) region->border.ShareMaxima({&longest.limits, &longest.metres});
  const int substeps = ChooseSubsteps(longest, seconds, steps, bodies, plane.lengths);
  plane.statistics = {};
  plane.statistics.substeps = substeps;
  for (int k = 1; k <= substeps; ++k)
  {
    if (region != nullptr && k > 1)
    {
      region->bodies.Share();
      FindGroupTwists(bodies, plane.groups);
    }
    Substep(plane, seconds / substeps, static_cast<double>(k) / substeps, region);
  }
}

}  // namespace swarmanoid::kinematics2d
