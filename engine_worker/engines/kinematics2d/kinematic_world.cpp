// Two sizes follow from all bodies once, at the start: the median of the core radii limits how far a body may go in a
// substep, and the cells are wide enough for two such ways. A follower (a mirror of another engine) moves from a pose
// to another one during the tick; if that is farther than all substeps allow, it is put there at once. Grips are kept
// sorted, so that the order of commands cannot change a result.
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

#include <algorithm>
#include <stdexcept>

#include "engine_worker/engines/kinematics2d/region_tasks.h"
#include "engine_worker/engines/kinematics2d/step_constants.h"

namespace swarmanoid::kinematics2d
{

KinematicWorld::KinematicWorld(double elasticity) { plane_.contacts.elasticity = elasticity; }
KinematicWorld::~KinematicWorld() = default;
KinematicWorld::KinematicWorld(KinematicWorld&&) noexcept = default;
KinematicWorld& KinematicWorld::operator=(KinematicWorld&&) noexcept = default;

std::uint32_t KinematicWorld::AddModel(CollisionModel model)
{
  plane_.bodies.models.push_back(std::move(model));
  return static_cast<std::uint32_t>(plane_.bodies.models.size() - 1);
}

void KinematicWorld::ReplaceModel(std::uint32_t model, CollisionModel outline)
{
  plane_.bodies.models[model] = std::move(outline);
  if (regions_) regions_->ModelChanged(model);
}

std::uint32_t KinematicWorld::AddBody(std::uint32_t model, const Pose2& pose, bool follower)
{
  return plane_.bodies.Add(model, pose, follower);
}

void KinematicWorld::AddStatic(CollisionModel shape) { plane_.bodies.statics.push_back(std::move(shape)); }

void KinematicWorld::Start(Bounds area, unsigned threads, WorkerPool* pool)
{
  Bodies& bodies = plane_.bodies;
  std::vector<double> cores;
  for (std::uint32_t k = 0; k < bodies.count; ++k)
  {
    cores.push_back(CoreOf(bodies.ModelOf(k)));
    if (bodies.is_present[k] != 0) area.Include(bodies.now.x[k], bodies.now.y[k], bodies.RadiusOf(k));
  }
  double longest_way = 0;
  if (bodies.count > 0)
  {
    const auto middle = cores.begin() + static_cast<std::ptrdiff_t>(bodies.count / 2);
    std::nth_element(cores.begin(), middle, cores.end());
    bodies.median_core = *middle;
    for (std::uint32_t k = 0; k < bodies.count; ++k)
    {
      const double limit = bodies.LimitOf(bodies.ModelOf(k));
      longest_way = std::max(longest_way, limit);
      bodies.smallest_limit = std::min(bodies.smallest_limit, limit);
    }
  }
  plane_.Start(PlaneGrid::For(area, bodies.Radii(), 2 * (longest_way + kSlowestSeparation)), threads, pool);
}

void KinematicWorld::SetPresent(std::uint32_t body, bool present)
{
  std::uint8_t& is_present = plane_.bodies.is_present[body];
  if (regions_ && (is_present != 0) != present) regions_->BodyChanged(body);
  is_present = present ? 1 : 0;
}

void KinematicWorld::Place(std::uint32_t body, const Pose2& pose)
{
  plane_.bodies.now.Set(body, pose);
  if (regions_) regions_->BodyChanged(body);
}

void KinematicWorld::Follow(std::uint32_t body, const Pose2& from, const Pose2& goal, bool present)
{
  Bodies& bodies = plane_.bodies;
  const auto at = std::lower_bound(bodies.followers.begin(), bodies.followers.end(), body,
                                   [](const Follower& follower, std::uint32_t b) { return follower.body < b; });
  const double dx = goal.x - from.x;
  const double dy = goal.y - from.y;
  const double leap = kMostSubsteps * bodies.LimitOf(bodies.ModelOf(body));
  at->from = dx * dx + dy * dy > leap * leap ? goal : from;
  at->goal = goal;
  bodies.now.Set(body, at->from);
  bodies.is_present[body] = present ? 1 : 0;
}

void KinematicWorld::Advance(double seconds, int steps)
{
  if (regions_ && regions_->Advance(plane_, seconds, steps)) return;
  kinematics2d::Advance(plane_, seconds, steps);
}

void KinematicWorld::AddGrip(std::uint32_t body, std::uint32_t prey)
{
  std::vector<Grip>& grips = plane_.groups.grips;
  const Grip grip{body, prey, Relative(PoseOf(prey), PoseOf(body))};
  grips.insert(std::upper_bound(grips.begin(), grips.end(), grip, IsBefore), grip);
  plane_.groups.Rebuild(plane_.bodies);
}

void KinematicWorld::RemoveGrip(std::uint32_t body)
{
  RemoveGripsIf([body](const Grip& grip) { return grip.body == body; });
}

double KinematicWorld::OverlapForTest(std::uint32_t a, std::uint32_t b) const
{
  return Overlap(PlacedAt(a), PlacedAt(b));
}

double KinematicWorld::StaticOverlapForTest(std::uint32_t body) const
{
  double deepest = 0;
  for (const CollisionModel& shape : plane_.bodies.statics)
    deepest = std::max(deepest, Overlap(PlacedAt(body), Placed{.model = &shape}));
  return deepest;
}

void KinematicWorld::Split(RegionTeam& team) { regions_ = std::make_unique<RegionTasks>(plane_, team); }

void KinematicWorld::MoveCuts(std::span<const std::uint8_t> region_of_block)
{
  regions_->SetCuts(plane_, region_of_block);
}

std::vector<std::uint32_t> KinematicWorld::BodiesInBlocks() const
{
  const BroadPhase& broad = plane_.contacts.broad;
  std::vector<std::uint32_t> in_cells(broad.Cells().Count(), 0);
  std::vector<std::uint32_t> cells(BodyCount());
  broad.Cells().FindCells({Poses().x.data(), BodyCount()}, {Poses().y.data(), BodyCount()}, cells.data());
  for (const std::uint32_t cell : cells) ++in_cells[cell];
  std::vector<std::uint32_t> in_blocks(BlockCount(), 0);
  for (std::uint32_t block = 0; block < in_blocks.size(); ++block)
    broad.ForEachRowOf(block,
                       [&](std::uint32_t first, std::uint32_t last)
                       {
                         for (std::uint32_t cell = first; cell <= last; ++cell) in_blocks[block] += in_cells[cell];
                       });
  return in_blocks;
}

void KinematicWorld::SaveState(ByteWriter& state) const
{
  const Bodies& bodies = plane_.bodies;
  const PoseStore& now = bodies.now;
  for (const double* values : {now.x.data(), now.y.data(), now.z.data(), now.w.data(), bodies.turret_angle.data()})
    state.PutArray(std::span(values, bodies.count));
  state.PutArray(bodies.is_present);
  state.PutArray(plane_.groups.grips);
}

void KinematicWorld::LoadState(ByteReader& state)
{
  Bodies& bodies = plane_.bodies;
  std::vector<Grip>& grips = plane_.groups.grips;
  const auto read = [&](auto& values)
  {
    const auto saved = state.GetArray<typename std::remove_cvref_t<decltype(values)>::value_type>();
    if (saved.size() != bodies.count)
      throw std::runtime_error("saved state of a kinematic world: it is of another experiment");
    std::copy(saved.begin(), saved.end(), values.begin());
  };
  for (auto* values : {&bodies.now.x, &bodies.now.y, &bodies.now.z, &bodies.now.w}) read(*values);
  read(bodies.turret_angle);
  read(bodies.is_present);
  for (std::uint32_t k = 0; k < bodies.count; ++k) SetTurretAngle(k, bodies.turret_angle[k]);
  grips = state.GetArray<Grip>();
  for (const Grip& grip : grips)
    if (grip.body >= bodies.count || grip.prey >= bodies.count)
      throw std::runtime_error("saved state of a kinematic world: a grip of a body that does not exist");
  if (!std::is_sorted(grips.begin(), grips.end(), IsBefore))
    throw std::runtime_error("saved state of a kinematic world: its grips are not in order");
  grips.reserve(bodies.count);
  plane_.groups.Rebuild(bodies);
  if (regions_) regions_->AllChanged();
}

}  // namespace swarmanoid::kinematics2d
