// This file maps the space to the plane of a KinematicWorld and back. Bodies are numbered as the engine's entities, in
// their order; mirrors of other engines follow their owners. Robots and preys stand on the plane, whereas a block keeps
// its height and lean, so its outline is the cut of the plane, and each block has an outline of its own. A mirror that
// another engine turns gets a new cut in each tick.
//
// The grid of cells follows from the initial poses alone. So an engine that is made in the middle of a run and restored
// has the same cells, and computes the same numbers, as one that ran from the start.
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "common/math/elementary.h"
#include "common/space/shape.h"
#include "common/space/space.h"
#include "engine_worker/engines/kinematics2d/plane_region.h"
#include "engine_worker/engines/kinematics2d/region_cuts.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/engines/terrain_walls.h"
#include "engine_worker/volume_members.h"

namespace swarmanoid
{
namespace
{

using namespace kinematics2d;

constexpr std::uint64_t kBalancePeriod = 64;  // ticks
// A mirror that jumps farther than this in a tick was put elsewhere; it pushes nothing on its way.
constexpr double kMirrorJump_m = 0.5;

bool HasTurret(const CSwarmanoidSpaceEntity& entity)
{
  return DescriptionOf(entity.GetKind()).mechanism == Mechanism::kTurretGripper;
}

bool IsTerrain(const CSwarmanoidSpaceEntity& entity)
{
  return DescriptionOf(entity.GetKind()).role == EntityRole::kTerrain;
}

bool IsPrey(const CSwarmanoidSpaceEntity& entity)
{
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  return kind.role == EntityRole::kObject && kind.grippable;
}

// Returns the area of the plane that the arena covers.
Bounds AreaOf(const PlaneFrame& frame, const Vector3& arena)
{
  Bounds area{1e300, 1e300, -1e300, -1e300};
  for (unsigned corner = 0; corner < 8; ++corner)
  {
    const Vector3 part((corner & 1) != 0 ? 1 : 0, (corner & 2) != 0 ? 1 : 0, (corner & 4) != 0 ? 1 : 0);
    const PlanePose pose = frame.ToPlane({arena.cwiseProduct(part), Quaternion::Identity()});
    area.Include(pose.u, pose.v, 0);
  }
  return area;
}

}  // namespace

void Kinematics2dEngine::Init(const EngineSetup& setup)
{
  space_ = &setup.space;
  layout_ = &setup.layout;
  configuration_ = &setup.configuration;
  subclock_ = std::max(setup.configuration.subclock, 1);
  frame_ = PlaneFrom(setup.parameters);
  threads_ = static_cast<unsigned>(setup.parameters.Integer("threads"));
  if (threads_ == 0)
  {
    threads_ = setup.threads;
    pool_ = setup.pool;
  }
  friction_ = setup.parameters.Number("friction");
  wall_friction_ = setup.parameters.Number("wall_friction");
  world_ = KinematicWorld(setup.parameters.Number("elasticity"));
  robots_.Init(setup.space, frame_, *this);
  team_ = setup.team;
}

void Kinematics2dEngine::AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding)
{
  if (binding == EBinding::kOwned)
    owned_.push_back(&entity);
  else if (binding == EBinding::kMirror)
    mirrors_.push_back({&entity});
  else if (HasBody(entity.GetKind()) || IsTerrain(entity))
    fixed_.push_back(&entity);
}

// From the initial poses alone, so that an engine made in mid-run to be restored has the same grid as one of the start.
void Kinematics2dEngine::Start()
{
  CollisionModel outline = FootbotModel();
  outline.friction = friction_;
  const std::uint32_t footbot_model = world_.AddModel(std::move(outline));
  std::map<std::tuple<bool, double, double, double>, std::uint32_t> models;  // by form, size and friction
  const auto model_for = [&](const CSwarmanoidSpaceEntity& entity)
  {
    if (HasTurret(entity)) return footbot_model;
    // The plane cuts each free box at another height, so each has a model of its own.
    if (IsFreeBox(entity.GetKind())) return world_.AddModel(ModelOf(entity));
    const bool is_box = DescriptionOf(entity.GetKind()).form == BodyForm::kBox;
    const auto [known, is_new] =
        models.try_emplace({is_box, entity.GetSize().x(), entity.GetSize().y(), FrictionOf(entity)}, 0);
    if (is_new) known->second = world_.AddModel(ModelOf(entity));
    return known->second;
  };

  std::vector<PlaneWriter::Stance> stances;
  for (const CSwarmanoidSpaceEntity* entity : owned_)
  {
    // Robots and preys stand on the plane; blocks keep their height and lean.
    robots_.AddOwned(*entity);
    const bool block = IsFreeBox(entity->GetKind());
    const std::uint32_t model = model_for(*entity);
    const std::uint32_t body = world_.AddBody(model, PlanePoseOf(entity->GetConfiguration().pose));
    if (block) stances.push_back({body, frame_.StanceOf(entity->GetConfiguration().pose)});
    world_.SetPresent(body, entity->GetConfiguration().reserve.empty());
    if (block && world_.ModelOf(body).polygons.empty())
      throw ConfigurationError(entity->GetConfiguration().location,
                               "the plane of engine '" + configuration_->id + "' does not cut the block '" +
                                   entity->GetId() + "'; move the block or the plane, or list it in another engine");
    const std::optional<WheelDrive>& wheels = DescriptionOf(entity->GetKind()).wheels;
    wheels_.push_back(wheels ? Wheels{wheels->radius_m, 1 / wheels->axle_m} : Wheels{});
    if (IsPrey(*entity))
    {
      preys_.push_back(body);
      near_preys_.Add(world_.ModelOf(body).bounding_radius);
    }
    if (HasTurret(*entity))
    {
      footbots_.push_back({body, entity->SlotOf("gripper_aperture"), entity->SlotOf("gripped"),
                           entity->SlotOf("turret_angle"), std::nullopt});
    }
  }
  for (Mirror& mirror : mirrors_)
  {
    CollisionModel model = ModelOf(*mirror.entity);
    // However another engine turns a block, the plane cuts it within this circle.
    if (IsFreeBox(mirror.entity->GetKind())) model.bounding_radius = mirror.entity->GetSize().norm() / 2;
    mirror.model = world_.AddModel(std::move(model));
    mirror.body = world_.AddBody(mirror.model, PlanePoseOf(mirror.entity->GetConfiguration().pose), true);
    const std::uint32_t entity = mirror.entity->GetIndex();
    if (std::ranges::binary_search(layout_->changing, entity)) mirror.own = BodyOf(entity);
  }
  for (const CSwarmanoidSpaceEntity* entity : fixed_)
  {
    if (IsTerrain(*entity))
    {
      for (const std::vector<Vector2>& wall :
           TerrainWalls(entity->GetConfiguration(), space_->GetExperiment().folder, frame_))
        AddStatic(MakeModel({}, {MakePolygon(wall)}), wall_friction_);
      continue;
    }
    AddFixed(*entity);
  }
  for (const ChannelBlock& block : layout_->sensors)
  {
    if (block.name == "footbot_encoders") world_.KeepTravel();
    if (block.name == "footbot_turret_torque") tick_start_.resize(footbots_.size());
  }
  for (const ChannelBlock& block : layout_->commands)
    footbots_change_ |= block.name == "footbot_turret" || block.name == "footbot_gripper";
  world_.Start(AreaOf(frame_, space_->GetExperiment().arena_size), threads_, pool_);
  for (const Footbot& footbot : footbots_)
    world_.SetTurretAngle(footbot.body, space_->Attributes()[footbot.turret_slot]);
  writer_ = PlaneWriter(frame_, owned_.size(), std::move(stances));
  is_elsewhere_.assign(owned_.size(), 0);
  std::vector<const CSwarmanoidSpaceEntity*>().swap(owned_);
  if (team_ != nullptr) world_.Split(*team_);
}

std::unique_ptr<EngineRegion> Kinematics2dEngine::MakeRegion(unsigned region, RegionExchange& exchange)
{
  return std::make_unique<PlaneRegion>(region, exchange);
}

void Kinematics2dEngine::BalanceRegions()
{
  if (team_ == nullptr || updates_++ % kBalancePeriod != 0) return;
  world_.MoveCuts(CutPlane(world_.BodiesInBlocks(), world_.BlockColumns(), configuration_->split));
}

void Kinematics2dEngine::AddFixed(const CSwarmanoidSpaceEntity& entity)
{
  const Pose& pose = entity.GetConfiguration().pose;
  const Shape shape = ShapeOf(entity.GetConfiguration());
  if (shape.kind == Shape::Kind::kCylinder)
  {
    if (!frame_.CutsUpright(pose, entity.GetSize().z())) return;
    const PlanePose flat = frame_.ToPlane(pose);
    const Circle circle{flat.u, flat.v, shape.half_size.x()};
    AddStatic(MakeModel({&circle, 1}, {}), FrictionOf(entity));
    return;
  }
  const std::vector<Vector2> outline = frame_.CutBody(entity, pose);
  if (!outline.empty()) AddStatic(MakeModel({}, {MakePolygon(outline)}), FrictionOf(entity));
}

void Kinematics2dEngine::AddStatic(CollisionModel shape, double friction)
{
  shape.friction = friction;
  world_.AddStatic(std::move(shape));
}

double Kinematics2dEngine::FrictionOf(const CSwarmanoidSpaceEntity& entity) const
{
  return entity.GetConfiguration().tree.GetNumber("friction", entity.IsMovable() ? friction_ : wall_friction_);
}

Pose2 Kinematics2dEngine::PlanePoseOf(const Pose& pose) const
{
  const PlanePose flat = frame_.ToPlane(pose);
  return {flat.u, flat.v, RotorOf(flat.heading)};
}

CollisionModel Kinematics2dEngine::ModelOf(const CSwarmanoidSpaceEntity& entity) const
{
  const Vector3& size = entity.GetSize();
  if (!(size.x() > 0 && size.y() > 0))
    throw ConfigurationError(entity.GetConfiguration().location, "'" + entity.GetId() + "' has no size; engine '" +
                                                                     configuration_->id + "' cannot move it");
  if (HasTurret(entity)) return FootbotModel();
  if (IsFreeBox(entity.GetKind())) return Outline(entity, entity.GetConfiguration().pose);
  const bool is_box = DescriptionOf(entity.GetKind()).form == BodyForm::kBox;
  CollisionModel model = is_box ? RectangleModel(size.x(), size.y()) : CircleModel(size.x());
  model.friction = FrictionOf(entity);
  return model;
}

CollisionModel Kinematics2dEngine::Outline(const CSwarmanoidSpaceEntity& block, const Pose& at) const
{
  const PlanePose pose = frame_.ToPlane(at);
  const SinCos heading = SinCosOf(pose.heading);
  std::vector<Vector2> points = frame_.CutBody(block, at);
  for (Vector2& point : points)
  {
    const double x = point.x() - pose.u;
    const double y = point.y() - pose.v;
    point = {heading.cos * x + heading.sin * y, heading.cos * y - heading.sin * x};
  }
  std::vector<Polygon> polygons;
  if (!points.empty()) polygons.push_back(MakePolygon(points));
  CollisionModel model = MakeModel({}, std::move(polygons));
  model.friction = FrictionOf(block);
  return model;
}

void Kinematics2dEngine::Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors)
{
  FollowMirrors();
  WorkerPool* const pool = IfItShares(pool_);
  ApplyCommands(commands, pool);
  for (std::size_t k = 0; k < tick_start_.size(); ++k) tick_start_[k] = world_.PoseOf(footbots_[k].body);
  BalanceRegions();
  world_.Advance(TickSeconds(), subclock_);
  writer_.Write(world_.Poses(), update.poses, pool);
  robots_.Raise(layout_->owned, update.poses);
  ReportFootbots(update.attributes);
  robots_.Report(update.attributes);
  for (const ChannelBlock& block : layout_->sensors)
  {
    const std::span<double> values =
        sensors.subspan(block.offset, block.entities.size() * static_cast<std::size_t>(block.width));
    if (block.name == "footbot_encoders") ReadEncoders(block, values);
    if (block.name == "footbot_turret_torque") ReadTurretTorques(block, values);
    robots_.Sense(block, values);
  }
}

// A mirror begins a tick where the space has it. Its engine moves it in this tick, too, so it is taken to go on as in
// the last one: along the same arc.
void Kinematics2dEngine::FollowMirrors()
{
  for (Mirror& mirror : mirrors_)
  {
    const Pose pose = mirror.entity->GetPose();
    bool present;
    if (IsFreeBox(mirror.entity->GetKind()))
    {
      CollisionModel outline = Outline(*mirror.entity, pose);
      present = !outline.polygons.empty();
      world_.ReplaceModel(mirror.model, std::move(outline));
    }
    else
      present = frame_.CutsUpright(pose, mirror.entity->GetSize().z());
    if (mirror.own != kNobody && is_elsewhere_[mirror.own] == 0)
      present = false;
    else if (mirror.own != kNobody)
    {
      const bool is_ghost = IsGhost(*space_, configuration_->volume, mirror.entity->GetIndex());
      FollowGhost(mirror.own, pose, is_ghost && present);
      present = present && !is_ghost;
    }
    const Pose2 now = PlanePoseOf(pose);
    const double dx = now.x - mirror.previous.x;
    const double dy = now.y - mirror.previous.y;
    const bool goes_on = mirror.is_known != 0 && dx * dx + dy * dy < kMirrorJump_m * kMirrorJump_m;
    world_.Follow(mirror.body, now, goes_on ? Compose(now, Relative(mirror.previous, now)) : now, present);
    mirror.previous = now;
    mirror.is_known = 1;
  }
}

void Kinematics2dEngine::MirrorMoved(std::uint32_t entity)
{
  for (Mirror& mirror : mirrors_)
    if (mirror.entity->GetIndex() == entity) mirror.is_known = 0;
}

void Kinematics2dEngine::FollowGhost(std::uint32_t body, const Pose& pose, bool present)
{
  world_.SetPresent(body, present);
  if (!present) return;
  if (IsFootbot(body)) world_.SetTurretAngle(body, space_->Attributes()[FootbotOf(body).turret_slot]);
  world_.Place(body, PlanePoseOf(pose));
}

void Kinematics2dEngine::FollowAttributes(Footbot& footbot)
{
  footbot.aperture.reset();
  world_.SetTurretAngle(footbot.body, space_->Attributes()[footbot.turret_slot]);
}

void Kinematics2dEngine::EntityMoved(std::uint32_t entity)
{
  const std::uint32_t body = BodyOf(entity);
  world_.RemoveGripsIf(
      [&](const Grip& grip)
      {
        return (grip.body == body || grip.prey == body) &&
               !space_->Structure().Holds(layout_->owned[grip.body], layout_->owned[grip.prey]);
      });
  world_.Place(body, PlanePoseOf(space_->GetPose(entity)));
  robots_.Moved(entity);
  world_.SetPresent(body, space_->IsPresent(entity));
}

void Kinematics2dEngine::TakeOver(std::uint32_t entity, const EntityVelocity& velocity)
{
  const std::uint32_t body = BodyOf(entity);
  is_elsewhere_[body] = 0;
  if (IsFootbot(body)) FollowAttributes(FootbotOf(body));
  reported_ = 0;
  const Pose pose = space_->GetPose(entity);
  world_.Place(body, PlanePoseOf(pose));
  robots_.TakeOver(entity, frame_.StanceOf(pose).height, velocity);
  world_.SetPresent(body, space_->IsPresent(entity));
}

void Kinematics2dEngine::HandOver(std::uint32_t entity)
{
  const std::uint32_t body = BodyOf(entity);
  is_elsewhere_[body] = 1;
  world_.RemoveGripsIf([body](const Grip& grip) { return grip.body == body || grip.prey == body; });
  world_.SetTwist(body, {});
  if (IsFootbot(body)) world_.SetTurretRate(body, 0);
  robots_.HandOver(entity);
  world_.SetPresent(body, false);
}

std::uint32_t Kinematics2dEngine::BodyOf(std::uint32_t entity) const
{
  return static_cast<std::uint32_t>(std::lower_bound(layout_->owned.begin(), layout_->owned.end(), entity) -
                                    layout_->owned.begin());
}

void Kinematics2dEngine::SaveState(ByteWriter& state) const
{
  world_.SaveState(state);
  robots_.SaveState(state);
  for (const Mirror& mirror : mirrors_)
  {
    state.Put(mirror.previous);
    state.Put(mirror.is_known);
  }
}

void Kinematics2dEngine::LoadState(ByteReader& state)
{
  world_.LoadState(state);
  robots_.LoadState(state);
  for (Mirror& mirror : mirrors_)
  {
    mirror.previous = state.Get<Pose2>();
    mirror.is_known = state.Get<std::uint8_t>();
  }
  reported_ = 0;
}

void Kinematics2dEngine::BeginAgain()
{
  for (Mirror& mirror : mirrors_) mirror.is_known = 0;
  for (Footbot& footbot : footbots_) FollowAttributes(footbot);
  reported_ = 0;
}

std::string Kinematics2dEngine::StatusText() const
{
  const WorldStatistics& s = world_.Statistics();
  return std::to_string(s.substeps) + " substeps, " + std::to_string(s.pairs) + " pairs, " +
         std::to_string(s.contacts) + " contacts, " + std::to_string(s.held_back) + " held back";
}

}  // namespace swarmanoid
