// KinematicWorld::Division: what goes to the processes of the regions, and comes back.
#include "engine_worker/engines/kinematics2d/kinematic_division.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "engine_worker/engines/kinematics2d/kinematic_region.h"

namespace swarmanoid::kinematics2d
{
namespace
{

constexpr std::uint8_t kNoRegion = 0xff;
constexpr std::size_t kPieceOfPlan = 1 << 19;  // bytes
constexpr std::uint32_t kMostThreads = 64;

// All of a model but its polygons.
struct ModelImage
{
  CollisionModel::PartValues x, y, radius;
  std::array<std::uint8_t, 8> on_turret;
  std::uint32_t parts, circles;
  double bounding_radius, core_radius;
};

void PutModel(const CollisionModel& model, ByteWriter& message)
{
  ModelImage image{model.part_x,
                   model.part_y,
                   model.part_radius,
                   {},
                   static_cast<std::uint32_t>(model.parts),
                   static_cast<std::uint32_t>(model.circles),
                   model.bounding_radius,
                   model.core_radius};
  std::ranges::copy(model.on_turret, image.on_turret.begin());
  message.Put(image);
  message.PutArray(model.polygons);
}

// Nothing for what is no model.
std::optional<CollisionModel> GetModel(ByteReader& message)
{
  const auto image = message.Get<ModelImage>();
  CollisionModel model;
  model.part_x = image.x;
  model.part_y = image.y;
  model.part_radius = image.radius;
  for (std::size_t k = 0; k < model.on_turret.size(); ++k) model.on_turret[k] = image.on_turret[k] != 0;
  model.parts = static_cast<int>(image.parts);
  model.circles = static_cast<int>(image.circles);
  model.bounding_radius = image.bounding_radius;
  model.core_radius = image.core_radius;
  model.polygons = message.GetArray<Polygon>();
  const bool is_model = image.parts <= CollisionModel::kMaximumParts &&
                        image.circles + model.polygons.size() == image.parts &&
                        std::ranges::all_of(model.polygons, [](const Polygon& p)
                                            { return p.count >= 3 && p.count <= Polygon::kMaximumVertices; });
  return is_model ? std::optional(std::move(model)) : std::nullopt;
}

}  // namespace

void KinematicWorld::Divide(RegionTeam& team) { division_ = std::make_unique<Division>(*this, team); }

void KinematicWorld::MoveCuts(std::span<const std::uint8_t> region_of_block)
{
  division_->SetCuts(*this, region_of_block);
}

KinematicWorld::Division::Division(const KinematicWorld& world, RegionTeam& team)
    : team_(team), bodies_(team.RegionCount()), results_(team.RegionCount())
{
  if (team.RegionCount() < 1 || team.RegionCount() > EngineSplit::kMostRegions)
    throw std::runtime_error("a plane can be cut into 1 to 32 regions");
  region_of_body_.assign(world.count_, kNoRegion);
  SetCuts(world, std::vector<std::uint8_t>(world.broad_.BlockCount(), 0));
}

void KinematicWorld::Division::Refuse(const char* what)
{
  throw std::runtime_error(std::string("a region of the plane does not fit the others: ") + what);
}

void KinematicWorld::Division::SetCuts(const KinematicWorld& world, std::span<const std::uint8_t> region_of_block)
{
  CheckCuts(world.broad_, region_of_block, team_.RegionCount());
  if (std::ranges::equal(region_of_block, region_of_block_)) return;
  region_of_block_.assign(region_of_block.begin(), region_of_block.end());
  region_of_cell_.assign(world.broad_.Cells().Count(), 0);
  for (std::uint32_t block = 0; block < region_of_block_.size(); ++block)
    world.broad_.ForEachRowOf(
        block, [&](std::uint32_t first, std::uint32_t last)
        { std::fill(region_of_cell_.begin() + first, region_of_cell_.begin() + last + 1, region_of_block_[block]); });
  knows_cuts_ = false;
}

bool KinematicWorld::Division::Advance(KinematicWorld& world, double seconds, int steps)
{
  if (!team_.IsReady())
  {
    knows_all_ = false;
    return false;
  }
  ByteWriter plan;
  bool tells_all = !knows_all_;
  bool is_done = false;
  for (std::uint32_t piece = 0; !is_done; ++piece)
    team_.Work(
        tells_all && piece == 0,
        [&](bool anew, std::span<ByteWriter> tasks)
        {
          if (anew)
          {
            tells_all = true;
            piece = 0;
            plan = PlanOf(world);
          }
          const std::span<const char> bytes(plan.Bytes());
          const std::span<const char> rest = bytes.subspan(std::min(piece * kPieceOfPlan, bytes.size()));
          is_done = rest.size() <= kPieceOfPlan;
          const bool has_changes = !changed_.empty();
          tasks[0].Put(TaskStart{piece, !is_done, tells_all, has_changes, {}});
          if (tells_all) tasks[0].PutArray(rest.first(std::min(rest.size(), kPieceOfPlan)));
          if (is_done) WriteForAll(world, tells_all, seconds, steps, tasks[0]);
          for (std::size_t region = 1; region < tasks.size(); ++region) tasks[region] = tasks[0];
          if (is_done) tells_all ? WriteBodies(world, tasks) : WriteChanges(world, tasks);
        },
        results_);
  knows_all_ = knows_cuts_ = true;
  changed_.clear();
  changed_models_.clear();
  world.statistics_ = {};
  std::ranges::fill(region_of_body_, kNoRegion);
  for (unsigned region = 0; region < results_.size(); ++region) ReadResult(world, region, results_[region]);
  for (const Follower& follower : world.followers_) world.now_.Set(follower.body, follower.goal);
  std::size_t told = 0;
  for (const std::vector<std::uint32_t>& bodies : bodies_) told += bodies.size();
  if (told + world.followers_.size() != world.count_) Refuse("not all bodies were told of");
  return true;
}

// What stays as it is as long as a region knows all, or is replaced by name.
ByteWriter KinematicWorld::Division::PlanOf(const KinematicWorld& world)
{
  ByteWriter plan;
  plan.Put(Outset{world.broad_.Grid(), world.elasticity_, world.median_core_, world.smallest_limit_,
                  world.own_pool_ ? static_cast<std::uint32_t>(world.parts_.size()) : 1, world.keeps_travel_});
  for (const std::vector<CollisionModel>* models : {&world.models_, &world.statics_})
  {
    plan.Put(static_cast<std::uint64_t>(models->size()));
    for (const CollisionModel& model : *models) PutModel(model, plan);
  }
  plan.PutEach(world.followers_.size(),
               [&](std::size_t k)
               {
                 const std::uint32_t body = world.followers_[k].body;
                 return FollowerPlan{body, world.model_[body]};
               });
  return plan;
}

void KinematicWorld::Division::WriteForAll(const KinematicWorld& world, bool anew, double seconds, int steps,
                                           ByteWriter& task) const
{
  task.Put(seconds);
  task.Put(steps);
  task.PutArray(knows_cuts_ && !anew ? std::vector<std::uint8_t>() : region_of_block_);
  task.Put(static_cast<std::uint64_t>(changed_models_.size()));
  for (const std::uint32_t model : changed_models_)
  {
    task.Put(model);
    PutModel(world.models_[model], task);
  }
  std::vector<FollowerTask> followers;
  for (const Follower& follower : world.followers_)
    followers.push_back({world.now_.Get(follower.body), follower.from, follower.goal, world.present_[follower.body]});
  task.PutArray(followers);
  task.PutArray(world.grips_);
}

// Each body is told to the region that it is in.
void KinematicWorld::Division::WriteBodies(const KinematicWorld& world, std::span<ByteWriter> tasks)
{
  cells_.resize(world.count_);
  world.broad_.Cells().FindCells({world.now_.x.data(), world.count_}, {world.now_.y.data(), world.count_},
                                 cells_.data());
  for (std::uint32_t body = 0; body < world.count_; ++body)
    if (!world.IsFollower(body)) Region::PutBody(world, body, body, tasks[region_of_cell_[cells_[body]]]);
}

// Regions know their bodies, and in which order they told them.
void KinematicWorld::Division::WriteChanges(const KinematicWorld& world, std::span<ByteWriter> tasks)
{
  std::vector<std::vector<ChangedBody>> changed(tasks.size());
  for (const std::uint32_t body : changed_)
    if (!world.IsFollower(body))
      changed[region_of_body_[body]].push_back({body, world.present_[body], world.now_.Get(body)});
  std::vector<std::vector<TurretRate>> rates(tasks.size());
  for (const Turret& turret : world.turrets_)
    rates[region_of_body_[turret.body]].push_back({turret.body, 0, turret.rate});
  for (std::size_t region = 0; region < tasks.size(); ++region)
  {
    const std::vector<std::uint32_t>& bodies = bodies_[region];
    tasks[region].PutArray(changed[region]);
    tasks[region].PutEach(bodies.size(), [&](std::size_t k) { return world.twists_.Get(bodies[k]); });
    tasks[region].PutArray(rates[region]);
  }
}

void KinematicWorld::Division::ReadResult(KinematicWorld& world, unsigned region, std::span<const char> bytes)
{
  ByteReader result(bytes);
  const auto statistics = result.Get<WorldStatistics>();
  world.statistics_.substeps = statistics.substeps;
  world.statistics_.pairs += statistics.pairs;
  world.statistics_.contacts += statistics.contacts;
  world.statistics_.held_back += statistics.held_back;
  std::vector<std::uint32_t>& bodies = bodies_[region];
  result.GetArray(bodies);
  for (const std::uint32_t body : bodies)
  {
    if (body >= world.count_ || world.IsFollower(body) || region_of_body_[body] != kNoRegion)
      Refuse("a body that there is not, or that another one told of");
    region_of_body_[body] = static_cast<std::uint8_t>(region);
  }
  const auto take = [&](auto& of_bodies)
  {
    const std::span<const char> values = result.GetImage<double>();
    if (values.size() != bodies.size() * sizeof(double)) Refuse("it told of other bodies");
    const char* value = values.data();
    for (const std::uint32_t body : bodies)
    {
      std::memcpy(&of_bodies[body], value, sizeof(double));
      value += sizeof(double);
    }
  };
  for (std::vector<double>* values : {&world.now_.x, &world.now_.y, &world.now_.z, &world.now_.w}) take(*values);
  for (const TurretAngle& turret : result.GetArray<TurretAngle>())
  {
    if (turret.number >= world.count_) Refuse("the turret of a body that there is not");
    world.SetTurretAngle(turret.number, turret.angle);
  }
  if (!world.keeps_travel_) return;
  take(world.travel_forward_);
  take(world.travel_turn_);
}

// With the followers alone.
std::unique_ptr<KinematicWorld> KinematicWorld::Division::WorldOf(std::span<const char> bytes, unsigned region,
                                                                  RegionExchange& exchange, unsigned halo)
{
  ByteReader plan(bytes);
  const auto outset = plan.Get<Outset>();
  if (!outset.grid.IsSound() || !(outset.median_core >= 0) || !(outset.smallest_limit > 0) || outset.threads < 1 ||
      outset.threads > kMostThreads)
    Refuse("a plan that is none");
  auto world = std::make_unique<KinematicWorld>(outset.elasticity);
  world->median_core_ = outset.median_core;
  world->smallest_limit_ = outset.smallest_limit;
  world->keeps_travel_ = outset.keeps_travel != 0;
  for (std::vector<CollisionModel>* models : {&world->models_, &world->statics_})
    for (auto count = plan.Get<std::uint64_t>(); count > 0; --count)
    {
      std::optional<CollisionModel> model = GetModel(plan);
      if (!model) Refuse("a model that is none");
      models->push_back(std::move(*model));
    }
  std::vector<std::uint32_t> numbers;
  for (const FollowerPlan& follower : plan.GetArray<FollowerPlan>())
  {
    if (follower.model >= world->models_.size() || (!numbers.empty() && follower.number <= numbers.back()))
      Refuse("a mirror that is none");
    numbers.push_back(follower.number);
    world->AddBody(follower.model, {}, true);
  }
  if (!plan.AtEnd()) Refuse("a plan that does not end");
  world->MakeRoom(outset.grid, outset.threads, nullptr);
  world->region_ = std::make_unique<Region>(*world, std::move(numbers), region, exchange, halo);
  return world;
}

void KinematicWorld::Division::DoTask(KinematicWorld& world, bool anew, ByteReader& task, ByteWriter& result)
{
  const auto seconds = task.Get<double>();
  const auto steps = task.Get<int>();
  if (const auto cuts = task.GetArray<std::uint8_t>(); !cuts.empty()) world.region_->SetCuts(world, cuts);
  for (auto models = task.Get<std::uint64_t>(); models > 0; --models)
  {
    const auto model = task.Get<std::uint32_t>();
    std::optional<CollisionModel> outline = GetModel(task);
    if (model >= world.models_.size() || !outline) Refuse("a model that is none");
    world.models_[model] = std::move(*outline);
  }
  const auto followers = task.GetArray<FollowerTask>();
  if (followers.size() != world.followers_.size()) Refuse("it has other mirrors");
  for (std::size_t k = 0; k < followers.size(); ++k)
  {
    Follower& follower = world.followers_[k];
    follower.from = followers[k].from;
    follower.goal = followers[k].goal;
    world.now_.Set(follower.body, followers[k].now);
    world.present_[follower.body] = followers[k].is_present != 0 ? 1 : 0;
  }
  world.region_->SetGrips(task.GetArray<Grip>());
  if (anew)
    world.region_->TakeBodies(world, task);
  else
    TakeChanges(world, task);
  world.Advance(seconds, steps);
  WriteResult(world, result);
}

void KinematicWorld::Division::TakeChanges(KinematicWorld& world, ByteReader& task)
{
  Region& region = *world.region_;
  const auto own = [&](std::uint32_t number)
  {
    const std::uint32_t body = region.FindBody(number);
    if (body >= world.count_ || !region.IsOwn(body)) Refuse("a body that it does not compute");
    return body;
  };
  for (const ChangedBody& changed : task.GetArray<ChangedBody>())
  {
    const std::uint32_t body = own(changed.number);
    world.now_.Set(body, changed.pose);
    world.present_[body] = changed.is_present != 0 ? 1 : 0;
  }
  const std::span<const char> twists = task.GetImage<Twist>();
  const std::span<const std::uint32_t> bodies = region.FindOwn();
  if (twists.size() != bodies.size() * sizeof(Twist)) Refuse("it computes other bodies");
  for (std::size_t k = 0; k < bodies.size(); ++k)
  {
    Twist twist;
    std::memcpy(&twist, twists.data() + k * sizeof(Twist), sizeof(Twist));
    world.twists_.Set(bodies[k], twist);
  }

  std::vector<std::uint32_t> stopped;
  const auto rates = task.GetArray<TurretRate>();
  auto rate = rates.begin();
  for (const Turret& turret : world.turrets_)
  {
    if (!region.IsOwn(turret.body)) continue;
    const std::uint32_t number = region.NumberInWhole(turret.body);
    rate = std::find_if(rate, rates.end(), [&](const TurretRate& r) { return r.number >= number; });
    if (rate == rates.end() || rate->number != number) stopped.push_back(turret.body);
  }
  for (const std::uint32_t body : stopped) world.SetTurretRate(body, 0);
  for (const TurretRate& turning : rates) world.SetTurretRate(own(turning.number), turning.rate);
}

void KinematicWorld::Division::WriteResult(const KinematicWorld& world, ByteWriter& result)
{
  Region& region = *world.region_;
  const std::span<const std::uint32_t> bodies = region.FindOwn();
  result.Put(world.statistics_);
  result.PutEach(bodies.size(), [&](std::size_t k) { return region.NumberInWhole(bodies[k]); });
  const auto put = [&](const auto& of_bodies)
  { result.PutEach(bodies.size(), [&](std::size_t k) { return of_bodies[bodies[k]]; }); };
  for (const std::vector<double>* of_bodies : {&world.now_.x, &world.now_.y, &world.now_.z, &world.now_.w})
    put(*of_bodies);
  std::vector<TurretAngle> turrets;
  for (const Turret& turret : world.turrets_)
    if (region.IsOwn(turret.body))
      turrets.push_back({region.NumberInWhole(turret.body), 0, world.turret_angle_[turret.body]});
  result.PutArray(turrets);
  if (!world.keeps_travel_) return;
  put(world.travel_forward_);
  put(world.travel_turn_);
}

PlaneRegion::PlaneRegion(unsigned region, RegionExchange& exchange, unsigned halo)
    : number_(region), exchange_(exchange), halo_(halo)
{
  const unsigned regions = exchange.RegionCount();
  if (regions < 1 || regions > EngineSplit::kMostRegions || region >= regions)
    throw std::runtime_error("a plane can be cut into 1 to 32 regions, numbered from 0");
}

PlaneRegion::~PlaneRegion() = default;

std::size_t PlaneRegion::BodyCount() const { return world_ ? world_->BodyCount() : 0; }

void PlaneRegion::Work(std::span<const char> bytes, ByteWriter& result)
{
  using Division = KinematicWorld::Division;
  ByteReader task(bytes);
  const auto start = task.Get<Division::TaskStart>();
  if (start.tells_all != 0)
  {
    if (start.piece == 0)
    {
      plan_.clear();
      world_.reset();
    }
    const auto piece = task.GetArray<char>();
    plan_.insert(plan_.end(), piece.begin(), piece.end());
    if (start.is_plan_alone != 0) return;
    world_ = Division::WorldOf(plan_, number_, exchange_, halo_);
    std::exchange(plan_, {});
  }
  if (!world_) Division::Refuse("it was told no plan");
  if (start.has_changes != 0) world_->region_->ShareOutAnew();
  Division::DoTask(*world_, start.tells_all != 0, task, result);
}

}  // namespace swarmanoid::kinematics2d
