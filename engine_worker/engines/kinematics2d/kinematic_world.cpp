#include "engine_worker/engines/kinematics2d/kinematic_world.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "common/math/elementary.h"
#include "engine_worker/engines/kinematics2d/kinematic_division.h"
#include "engine_worker/engines/kinematics2d/kinematic_limits.h"
#include "engine_worker/engines/kinematics2d/kinematic_region.h"

namespace swarmanoid::kinematics2d
{
namespace
{

Bounds BoxOf(const CollisionModel& model)
{
  Bounds box{1e300, 1e300, -1e300, -1e300};
  for (int k = 0; k < model.circles; ++k) box.Include(model.part_x[k], model.part_y[k], model.part_radius[k]);
  for (const Polygon& polygon : model.polygons)
    for (int k = 0; k < polygon.count; ++k) box.Include(polygon.x[k], polygon.y[k], 0);
  return box;
}

// A step never leads further than half of it.
double CoreOf(const CollisionModel& model)
{
  return std::max(model.core_radius, kThinnestCore * model.bounding_radius);
}

// The order of grips.
bool IsBefore(const Grip& a, const Grip& b) { return std::tie(a.prey, a.body) < std::tie(b.prey, b.body); }

}  // namespace

KinematicWorld::KinematicWorld(double elasticity) : elasticity_(elasticity) {}
KinematicWorld::~KinematicWorld() = default;
KinematicWorld::KinematicWorld(KinematicWorld&&) noexcept = default;
KinematicWorld& KinematicWorld::operator=(KinematicWorld&&) noexcept = default;

std::uint32_t KinematicWorld::AddModel(CollisionModel model)
{
  models_.push_back(std::move(model));
  return static_cast<std::uint32_t>(models_.size() - 1);
}

void KinematicWorld::ReplaceModel(std::uint32_t model, CollisionModel outline)
{
  models_[model] = std::move(outline);
  if (division_) division_->ModelChanged(model);
}

void KinematicWorld::SetPresent(std::uint32_t body, bool present)
{
  if (division_ && (present_[body] != 0) != present) division_->BodyChanged(body);
  present_[body] = present ? 1 : 0;
}

void KinematicWorld::Place(std::uint32_t body, const Pose2& pose)
{
  now_.Set(body, pose);
  if (division_) division_->BodyChanged(body);
}

std::uint32_t KinematicWorld::AddBody(std::uint32_t model, const Pose2& pose, bool follower)
{
  const auto body = static_cast<std::uint32_t>(count_++);
  now_.Resize(PaddedCount(count_));
  now_.Set(body, pose);
  model_.push_back(model);
  follower_.push_back(follower ? 1 : 0);
  present_.push_back(1);
  if (follower) followers_.push_back({body, pose, pose, pose});
  return body;
}

void KinematicWorld::AddStatic(CollisionModel shape) { statics_.push_back(std::move(shape)); }

void KinematicWorld::Start(Bounds area, unsigned threads, WorkerPool* pool)
{
  std::vector<double> cores, radii;
  for (std::size_t k = 0; k < count_; ++k)
  {
    const CollisionModel& model = models_[model_[k]];
    radii.push_back(model.bounding_radius);
    cores.push_back(CoreOf(model));
    if (present_[k] != 0) area.Include(now_.x[k], now_.y[k], model.bounding_radius);
  }
  // A wide body among narrow ones goes no further in a substep than they do, so that the cells can stay small.
  double longest_way = 0;
  smallest_limit_ = 1;
  if (count_ > 0)
  {
    const auto middle = cores.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
    std::nth_element(cores.begin(), middle, cores.end());
    median_core_ = *middle;
    for (std::size_t k = 0; k < count_; ++k)
    {
      const double limit = CoreLimitOf(models_[model_[k]]);
      longest_way = std::max(longest_way, limit);
      smallest_limit_ = std::min(smallest_limit_, limit);
    }
  }
  MakeRoom(PlaneGrid::For(area, radii, 2 * (longest_way + kSlowestSeparation)), threads, pool);
}

void KinematicWorld::MakeRoom(const PlaneGrid& grid, unsigned threads, WorkerPool* pool)
{
  if (pool == nullptr && threads > 1) own_pool_ = std::make_unique<WorkerPool>(threads);
  pool_ = pool != nullptr ? pool : own_pool_.get();
  parts_.resize(threads);
  const std::size_t padded = PaddedCount(count_);
  now_.Resize(padded);
  before_ = now_;
  placed_.resize(count_);
  for (const CollisionModel& shape : statics_) placed_.push_back({.model = &shape});
  twists_.Resize(padded);
  turret_angle_.resize(count_);
  turret_sin_.resize(count_);
  turret_sin_before_.resize(count_);
  turret_way_.resize(count_);
  way_.assign(padded, 0);
  travel_forward_.resize(count_);
  travel_turn_.resize(count_);
  mobility_.assign(count_ + 1, 0);
  leader_.resize(count_ + 1);
  for (std::uint32_t k = 0; k <= count_; ++k) leader_[k] = k;
  inverse_limit_.assign(padded, 1);
  std::vector<double> radii;
  for (std::uint32_t k = 0; k < count_; ++k)
  {
    inverse_limit_[k] = 1 / CoreLimitOf(ModelOf(k));
    radii.push_back(RadiusOf(k));
  }
  allowed_ = kAllowedOverlap * smallest_limit_ / kWayInCore;

  broad_.Configure(grid, radii);
  std::vector<Bounds> boxes;
  for (const CollisionModel& shape : statics_) boxes.push_back(BoxOf(shape));
  broad_.SetStatics(boxes);
  blocks_.assign(broad_.Blocks().begin(), broad_.Blocks().end());
  block_contacts_.resize(blocks_.size());
  verlet_list_.Configure(threads);
  solver_.Configure(count_, threads);
  limiter_.Configure(count_ + 1);
  is_involved_.assign(count_ + 1, 0);
  grips_.reserve(count_);
  group_start_.reserve(count_ + 1);
  turrets_.reserve(count_);
  RebuildGroups();
}

double KinematicWorld::CoreLimitOf(const CollisionModel& model) const
{
  return kWayInCore * std::min(CoreOf(model), kWidestCore * median_core_);
}

std::vector<KinematicWorld::Turret>::iterator KinematicWorld::FindTurret(std::uint32_t body)
{
  return std::lower_bound(turrets_.begin(), turrets_.end(), body,
                          [](const Turret& turret, std::uint32_t b) { return turret.body < b; });
}

void KinematicWorld::SetTurretRate(std::uint32_t body, double rate)
{
  const auto at = FindTurret(body);
  const bool known = at != turrets_.end() && at->body == body;
  if (rate == 0)
  {
    if (known)
    {
      turrets_.erase(at);
      SetTurretAngle(body, turret_angle_[body]);
    }
  }
  else if (known)
    at->rate = rate;
  else
    turrets_.insert(at, {body, rate, turret_angle_[body]});
}

void KinematicWorld::SetTurretAngle(std::uint32_t body, double angle)
{
  angle = WrapAngle(angle);
  if (turret_cos_.empty())
  {
    if (angle == 0) return;
    turret_cos_.assign(count_, 1);
    turret_cos_before_.assign(count_, 1);
  }
  turret_angle_[body] = angle;
  const SinCos turned = SinCosOf(angle);
  turret_cos_[body] = turret_cos_before_[body] = turned.cos;
  turret_sin_[body] = turret_sin_before_[body] = turned.sin;
  turret_way_[body] = 0;
}

void KinematicWorld::Follow(std::uint32_t body, const Pose2& pose, bool present)
{
  const auto at = std::lower_bound(followers_.begin(), followers_.end(), body,
                                   [](const Follower& follower, std::uint32_t b) { return follower.body < b; });
  const Pose2 from = now_.Get(body);
  const double dx = pose.x - from.x;
  const double dy = pose.y - from.y;
  const double leap = kMostSubsteps * CoreLimitOf(ModelOf(body));
  const bool appears = present && present_[body] == 0;
  at->from = appears || dx * dx + dy * dy > leap * leap ? pose : from;
  at->goal = pose;
  present_[body] = present ? 1 : 0;
}

void KinematicWorld::AddGrip(std::uint32_t body, std::uint32_t prey)
{
  const Grip grip{body, prey, Relative(now_.Get(prey), now_.Get(body))};
  grips_.insert(std::upper_bound(grips_.begin(), grips_.end(), grip, IsBefore), grip);
  RebuildGroups();
}

void KinematicWorld::RemoveGrip(std::uint32_t body)
{
  RemoveGripsIf([body](const Grip& grip) { return grip.body == body; });
}

const Grip* KinematicWorld::FindGrip(std::uint32_t body) const
{
  if (leader_[body] == body) return nullptr;
  // Its leader is what it holds.
  const auto found = std::lower_bound(grips_.begin(), grips_.end(), Grip{body, leader_[body], {}}, IsBefore);
  return found == grips_.end() || found->body != body ? nullptr : &*found;
}

void KinematicWorld::RebuildGroups()
{
  for (std::uint32_t k = 0; k < count_; ++k)
  {
    leader_[k] = k;
    mobility_[k] = IsFollower(k) ? 0 : 1;
  }
  group_start_.clear();
  for (std::size_t k = 0; k < grips_.size(); ++k)
  {
    leader_[grips_[k].body] = grips_[k].prey;
    if (k == 0 || grips_[k].prey != grips_[k - 1].prey) group_start_.push_back(static_cast<std::uint32_t>(k));
  }
  group_start_.push_back(static_cast<std::uint32_t>(grips_.size()));
  for (std::size_t g = 0; g + 1 < group_start_.size(); ++g)
    mobility_[grips_[group_start_[g]].prey] = 1.0 / (1 + group_start_[g + 1] - group_start_[g]);
}

// The grips of a prey.
std::span<const Grip> KinematicWorld::GroupOf(std::uint32_t prey) const
{
  const auto group = std::equal_range(grips_.begin(), grips_.end(), Grip{0, prey, {}},
                                      [](const Grip& a, const Grip& b) { return a.prey < b.prey; });
  return {group.first, group.second};
}

std::vector<std::uint32_t> KinematicWorld::BodiesInBlocks() const
{
  std::vector<std::uint32_t> in_cells(broad_.Cells().Count(), 0);
  std::vector<std::uint32_t> cells(count_);
  broad_.Cells().FindCells({now_.x.data(), count_}, {now_.y.data(), count_}, cells.data());
  for (const std::uint32_t cell : cells) ++in_cells[cell];
  std::vector<std::uint32_t> in_blocks(BlockCount(), 0);
  for (std::uint32_t block = 0; block < in_blocks.size(); ++block)
    broad_.ForEachRowOf(block,
                        [&](std::uint32_t first, std::uint32_t last)
                        {
                          for (std::uint32_t cell = first; cell <= last; ++cell) in_blocks[block] += in_cells[cell];
                        });
  return in_blocks;
}

double KinematicWorld::OverlapForTest(std::uint32_t a, std::uint32_t b) const
{
  return Overlap(PlaceAt(a, now_), PlaceAt(b, now_));
}

double KinematicWorld::StaticOverlapForTest(std::uint32_t body) const
{
  double deepest = 0;
  for (const CollisionModel& shape : statics_)
    deepest = std::max(deepest, Overlap(PlaceAt(body, now_), Placed{.model = &shape}));
  return deepest;
}

void KinematicWorld::SaveState(ByteWriter& state) const
{
  for (const double* values : {now_.x.data(), now_.y.data(), now_.z.data(), now_.w.data(), turret_angle_.data()})
    state.PutArray(std::span(values, count_));
  state.PutArray(present_);
  state.PutArray(grips_);
}

void KinematicWorld::LoadState(ByteReader& state)
{
  const auto read = [&](auto& values)
  {
    const auto saved = state.GetArray<typename std::remove_cvref_t<decltype(values)>::value_type>();
    if (saved.size() != count_)
      throw std::runtime_error("saved state of a kinematic world: it is of another experiment");
    std::copy(saved.begin(), saved.end(), values.begin());
  };
  for (auto* values : {&now_.x, &now_.y, &now_.z, &now_.w}) read(*values);
  read(turret_angle_);
  read(present_);
  for (std::uint32_t k = 0; k < count_; ++k) SetTurretAngle(k, turret_angle_[k]);
  grips_ = state.GetArray<Grip>();
  for (const Grip& grip : grips_)
    if (grip.body >= count_ || grip.prey >= count_)
      throw std::runtime_error("saved state of a kinematic world: a grip of a body that does not exist");
  if (!std::is_sorted(grips_.begin(), grips_.end(), IsBefore))
    throw std::runtime_error("saved state of a kinematic world: its grips are not in order");
  grips_.reserve(count_);
  RebuildGroups();
  if (division_) division_->AllChanged();
}

}  // namespace swarmanoid::kinematics2d
