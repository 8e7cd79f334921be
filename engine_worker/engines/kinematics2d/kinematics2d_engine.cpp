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

namespace swarmanoid
{
namespace
{

using namespace kinematics2d;

constexpr std::uint64_t kBalancePeriod = 64;  // ticks

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
  return kind.role == EntityRole::kObject && kind.form == BodyForm::kCylinder && kind.grippable;
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
  world_ = KinematicWorld(setup.parameters.Number("elasticity"));
  robots_.Init(setup.space, frame_, *this);
  team_ = setup.team;
}

void Kinematics2dEngine::AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding)
{
  if (binding == EBinding::kOwned)
    owned_.push_back(&entity);
  else if (binding == EBinding::kMirror)
    mirrors_.push_back({&entity, 0, 0});
  else if (HasBody(entity.GetKind()) || IsTerrain(entity))
    fixed_.push_back(&entity);
}

// From the initial poses alone, so that an engine made in mid-run to be restored has the same grid as one of the start.
void Kinematics2dEngine::Start()
{
  const std::uint32_t footbot_model = world_.AddModel(FootbotModel());
  std::map<std::tuple<bool, double, double>, std::uint32_t> models;  // by form and size
  const auto model_for = [&](const CSwarmanoidSpaceEntity& entity)
  {
    if (HasTurret(entity)) return footbot_model;
    // The plane cuts each free box elsewhere.
    if (IsFreeBox(entity.GetKind())) return world_.AddModel(ModelOf(entity));
    const bool is_box = DescriptionOf(entity.GetKind()).form == BodyForm::kBox;
    const auto [known, is_new] = models.try_emplace({is_box, entity.GetSize().x(), entity.GetSize().y()}, 0);
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
  }
  for (const CSwarmanoidSpaceEntity* entity : fixed_)
  {
    if (IsTerrain(*entity))
    {
      for (const std::vector<Vector2>& wall :
           TerrainWalls(entity->GetConfiguration(), space_->GetExperiment().folder, frame_))
        world_.AddStatic(MakeModel({}, {MakePolygon(wall)}));
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
    world_.AddStatic(MakeModel({&circle, 1}, {}));
    return;
  }
  const std::vector<Vector2> outline = frame_.CutBody(entity, pose);
  if (!outline.empty()) world_.AddStatic(MakeModel({}, {MakePolygon(outline)}));
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
  return is_box ? RectangleModel(size.x(), size.y()) : CircleModel(size.x());
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
  return MakeModel({}, std::move(polygons));
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
  }
}

void Kinematics2dEngine::FollowMirrors()
{
  for (const Mirror& mirror : mirrors_)
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
    world_.Follow(mirror.body, PlanePoseOf(pose), present);
  }
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

std::uint32_t Kinematics2dEngine::BodyOf(std::uint32_t entity) const
{
  return static_cast<std::uint32_t>(std::lower_bound(layout_->owned.begin(), layout_->owned.end(), entity) -
                                    layout_->owned.begin());
}

void Kinematics2dEngine::SaveState(ByteWriter& state) const
{
  world_.SaveState(state);
  robots_.SaveState(state);
}

void Kinematics2dEngine::LoadState(ByteReader& state)
{
  world_.LoadState(state);
  robots_.LoadState(state);
  reported_ = 0;
}

std::string Kinematics2dEngine::StatusText() const
{
  const WorldStatistics& s = world_.Statistics();
  return std::to_string(s.substeps) + " substeps, " + std::to_string(s.pairs) + " pairs, " +
         std::to_string(s.contacts) + " contacts, " + std::to_string(s.held_back) + " held back";
}

}  // namespace swarmanoid
