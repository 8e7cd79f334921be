#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "engine_worker/engines/dynamics2d/group_region.h"
#include "engine_worker/engines/plane_frame.h"
#include "engine_worker/engines/terrain_walls.h"
#include "engine_worker/volume_members.h"

namespace swarmanoid
{

using namespace dynamics2d;

namespace
{

// A mirror that jumps farther than this in a tick was put elsewhere; it pushes nothing on its way.
constexpr double kMirrorJump_m = 0.5;
constexpr double kSameOutline_m = 1e-6;
constexpr std::uint32_t kDynamics2dVersion = 6;  // of saved states
constexpr std::size_t kMostCorners = 6;          // of the cut of a box

}  // namespace

void CDynamics2dEngine::Init(const EngineSetup& setup)
{
  space_ = &setup.space;
  layout_ = &setup.layout;
  configuration_ = &setup.configuration;
  parameters_ = ReadDynamics2dParameters(setup.parameters);
  plane_ = PlaneFrom(setup.parameters);
  world_ =
      std::make_unique<Dynamics2dWorld>(WorldSettings{parameters_.velocity_iterations, parameters_.position_iterations,
                                                      parameters_.turret_torque, parameters_.grip_distance});
  const auto threads = static_cast<unsigned>(setup.parameters.Integer("threads"));
  if (threads == 0)
    world_->UseThreads(setup.threads, setup.pool);
  else
    world_->UseThreads(threads, nullptr);
  if (setup.team != nullptr) world_->UseRegions(*setup.team, std::max(threads, 1U));
  robots_.Init(setup.space, plane_, *this);
  steps_ = setup.configuration.subclock * parameters_.substeps;
  body_of_entity_.assign(space_->Size(), kNoBody);
  footbot_of_entity_.assign(space_->Size(), 0);
  for (const ChannelBlock& block : layout_->commands)
    if (block.name == "footbot_turret") turret_robots_ = block.entities;
}

// Robots and preys stand on the plane; blocks keep their height and lean.
PlanePose CDynamics2dEngine::StandingPose(const CSwarmanoidSpaceEntity& entity, PlaneStance& stance) const
{
  const Pose pose = entity.GetPose();
  stance = IsFreeBox(entity.GetKind()) ? plane_.StanceOf(pose) : PlaneStance{};
  return plane_.ToPlane(pose);
}

void CDynamics2dEngine::AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding)
{
  if (DescriptionOf(entity.GetKind()).role == EntityRole::kTerrain)
  {
    for (std::vector<Vector2>& wall : TerrainWalls(entity.GetConfiguration(), space_->GetExperiment().folder, plane_))
    {
      world_->AddBody(StaticModel(std::move(wall), parameters_), {});
      entity_of_body_.push_back(entity.GetIndex());
    }
    return;
  }
  if (!HasBody(entity.GetKind()))
  {
    if (binding != EBinding::kFixed)
      throw ConfigurationError(entity.GetConfiguration().location,
                               fmt::format("dynamics2d cannot move '{}': it has no body on the plane", entity.GetId()));
    return;
  }

  int body = kNoBody;
  PlaneStance stance;
  const PlanePose pose = StandingPose(entity, stance);
  switch (binding)
  {
    case EBinding::kFixed:
    {
      auto fixed = FixedModel(entity, plane_, parameters_);
      if (!fixed) return;
      body = world_->AddBody(std::move(fixed->model), fixed->pose);
      break;
    }
    case EBinding::kMirror:
    {
      body = world_->AddBody(MovableModel(entity, EMotion::kKinematic, plane_, parameters_), pose);
      mirrors_.push_back({&entity, body, false, {}});
      break;
    }
    case EBinding::kOwned:
    {
      // The check uses the start pose, since an engine that is made again in mid-run may find a block lifted by a
      // handbot.
      if (IsFreeBox(entity.GetKind()) && plane_.CutBody(entity, entity.GetConfiguration().pose).empty())
        throw ConfigurationError(
            entity.GetConfiguration().location,
            fmt::format("the {} '{}' does not reach the plane of the engine that moves it; put it on "
                        "the plane, or into another engine",
                        TagName(entity.GetKind()), entity.GetId()));
      BodyModel model = MovableModel(entity, EMotion::kDynamic, plane_, parameters_);
      model.has_turret_motor = std::binary_search(turret_robots_.begin(), turret_robots_.end(), entity.GetIndex());
      body = world_->AddBody(std::move(model), pose);
      owned_.push_back({&entity, body, stance, stance, pose});
      robots_.AddOwned(entity);
      if (DescriptionOf(entity.GetKind()).mechanism != Mechanism::kTurretGripper) break;
      footbot_of_entity_[entity.GetIndex()] = static_cast<std::uint32_t>(footbots_.size());
      Footbot& footbot = footbots_.emplace_back();
      footbot.entity = &entity;
      footbot.body = body;
      footbot.aperture_slot = entity.SlotOf("gripper_aperture");
      footbot.gripped_slot = entity.SlotOf("gripped");
      footbot.turret_slot = entity.SlotOf("turret_angle");
      break;
    }
  }
  body_of_entity_[entity.GetIndex()] = body;
  entity_of_body_.push_back(entity.GetIndex());
}

void CDynamics2dEngine::Start()
{
  for (const ChannelBlock& block : layout_->commands)
    if (block.name == "footbot_gripper")
      for (const std::uint32_t entity : block.entities) FootbotOf(entity).has_gripper = true;
  for (const ChannelBlock& block : layout_->sensors)
  {
    if (block.name == "footbot_encoders")
      for (const Footbot& footbot : footbots_)
        world_->MeasureWheels(footbot.body, DescriptionOf(footbot.entity->GetKind()).wheels->axle_m / 2);
    if (block.name == "footbot_turret_torque") world_->MeasureLoads();
    if (block.name == "footbot_accelerometer") reads_accelerometers_ = true;
  }
  world_->Build();
}

int CDynamics2dEngine::BodyOf(std::uint32_t entity) const { return body_of_entity_[entity]; }

CDynamics2dEngine::Footbot& CDynamics2dEngine::FootbotOf(std::uint32_t entity)
{
  return footbots_[footbot_of_entity_[entity]];
}

void CDynamics2dEngine::Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors)
{
  ReadCommands(commands);
  FollowMirrors();
  world_->BeginTick(space_->GetTickSeconds());
  ApplyGrippers();
  robots_.Advance(space_->GetTickSeconds());
  for (const std::uint32_t eyebot : robots_.Attached())
  {
    world_->SetDrive(BodyOf(eyebot), {});
    world_->SetVelocity(BodyOf(eyebot), {});
  }
  if (reads_accelerometers_)
    for (Footbot& footbot : footbots_) footbot.velocity = world_->VelocityOf(footbot.body);
  world_->Advance(steps_);
  WritePoses(update);
  robots_.Raise(layout_->owned, update.poses);
  ReportAttributes(update);
  robots_.Report(update.attributes);
  WriteSensors(sensors);
}

// A mirror stands where the space has it at the start of the tick, and goes on as it came.
void CDynamics2dEngine::FollowMirrors()
{
  const double tick = space_->GetTickSeconds();
  for (Mirror& mirror : mirrors_)
  {
    const PlanePose now = plane_.ToPlane(mirror.entity->GetPose());
    // An entity that changes its engine has another body, which this engine moves, or moves along as a ghost.
    const std::uint32_t entity = mirror.entity->GetIndex();
    const int own = BodyOf(entity);
    const bool reaches = ReachesPlane(*mirror.entity, plane_);
    const bool is_elsewhere = own != mirror.body && IsElsewhere(entity);
    const bool is_ghost = is_elsewhere && reaches && IsGhost(*space_, configuration_->volume, entity);
    world_->SetSolid(mirror.body, reaches && !is_ghost && (own == mirror.body || is_elsewhere));
    if (is_elsewhere) world_->SetSolid(own, is_ghost);
    const std::vector<Vector2> outline = MirrorOutline(*mirror.entity, plane_);
    if (!outline.empty()) world_->SetOutline(mirror.body, outline, kSameOutline_m);
    world_->Place(mirror.body, now);
    if (DescriptionOf(mirror.entity->GetKind()).mechanism == Mechanism::kTurretGripper)
      world_->SetTurretAngle(mirror.body, mirror.entity->GetAttribute("turret_angle"));
    const double du = now.u - mirror.previous.u;
    const double dv = now.v - mirror.previous.v;
    PlaneVelocity velocity;
    if (mirror.seen && du * du + dv * dv < kMirrorJump_m * kMirrorJump_m)
      velocity = {du / tick, dv / tick, WrapAngle(now.heading - mirror.previous.heading) / tick};
    world_->SetVelocity(mirror.body, velocity);
    if (is_ghost)
    {
      world_->Place(own, now);
      world_->SetVelocity(own, velocity);
      if (DescriptionOf(mirror.entity->GetKind()).mechanism == Mechanism::kTurretGripper)
        world_->SetTurretAngle(own, mirror.entity->GetAttribute("turret_angle"));
    }
    mirror.previous = now;
    mirror.seen = true;
  }
}

// Grippers that open come first, then grippers that close, in entity order.
void CDynamics2dEngine::ApplyGrippers()
{
  for (const Footbot& footbot : footbots_)
    if (footbot.has_gripper && footbot.gripper <= 0.5) world_->Release(footbot.body);
  for (const Footbot& footbot : footbots_)
  {
    if (!footbot.has_gripper || footbot.gripper <= 0.5 || world_->GrippedBy(footbot.body) != kNoBody) continue;
    const int target = world_->FindGrippable(footbot.body);
    if (target != kNoBody) world_->Grip(footbot.body, target);
  }
}

bool CDynamics2dEngine::Hold(std::uint32_t robot, std::uint32_t object)
{
  if (world_->WouldClose(BodyOf(robot), BodyOf(object))) return false;
  world_->Grip(BodyOf(robot), BodyOf(object));
  return true;
}

void CDynamics2dEngine::EntityMoved(std::uint32_t entity)
{
  for (Owned& owned : owned_)
  {
    if (owned.entity->GetIndex() != entity) continue;
    world_->ReleaseIf(owned.body,
                      [&](int body, int gripped)
                      {
                        return !space_->Structure().Holds(entity_of_body_[static_cast<std::size_t>(body)],
                                                          entity_of_body_[static_cast<std::size_t>(gripped)]);
                      });
    world_->Place(owned.body, StandingPose(*owned.entity, owned.stance));
    world_->SetVelocity(owned.body, {});
    robots_.Moved(entity);
  }
}

void CDynamics2dEngine::TakeOver(std::uint32_t entity, const EntityVelocity& velocity)
{
  const int body = BodyOf(entity);
  const CSwarmanoidSpaceEntity& it = space_->GetEntity(entity);
  const Quaternion to_plane = plane_.Frame().orientation.conjugate();
  const Vector3 linear = to_plane * velocity.linear;
  const Pose pose = space_->GetPose(entity);
  std::erase(elsewhere_, entity);
  world_->SetGrippable(body, DescriptionOf(it.GetKind()).grippable);
  world_->SetSolid(body, true);
  world_->Place(body, plane_.ToPlane(pose));
  world_->SetVelocity(body, {linear.x(), linear.y(), (to_plane * velocity.angular).z()});
  if (DescriptionOf(it.GetKind()).mechanism == Mechanism::kTurretGripper)
    world_->SetTurretAngle(body, it.GetAttribute("turret_angle"));
  robots_.TakeOver(entity, plane_.StanceOf(pose).height, velocity);
}

// The body stays where it is, and touches nothing until it is a ghost.
void CDynamics2dEngine::HandOver(std::uint32_t entity)
{
  const int body = BodyOf(entity);
  world_->ReleaseIf(body, [](int, int) { return true; });
  world_->SetDrive(body, {});
  world_->SetTurretSpeed(body, 0);
  world_->SetVelocity(body, {});
  world_->SetSolid(body, false);
  world_->SetGrippable(body, false);
  if (!IsElsewhere(entity)) elsewhere_.insert(std::ranges::upper_bound(elsewhere_, entity), entity);
  robots_.HandOver(entity);
}

bool CDynamics2dEngine::IsElsewhere(std::uint32_t entity) const
{
  return std::ranges::binary_search(elsewhere_, entity);
}

std::optional<EntityVelocity> CDynamics2dEngine::VelocityOf(std::uint32_t entity) const
{
  const PlaneVelocity velocity = world_->VelocityOf(BodyOf(entity));
  const Quaternion& to_space = plane_.Frame().orientation;
  return EntityVelocity{to_space * Vector3(velocity.u, velocity.v, 0), to_space * Vector3(0, 0, velocity.turn)};
}

void CDynamics2dEngine::MirrorMoved(std::uint32_t entity)
{
  for (Mirror& mirror : mirrors_)
    if (mirror.entity->GetIndex() == entity) mirror.seen = false;
}

void CDynamics2dEngine::SetVelocity(std::uint32_t entity, const PlaneVelocity& velocity)
{
  world_->SetVelocity(BodyOf(entity), velocity);
}

void CDynamics2dEngine::SaveState(ByteWriter& state) const
{
  state.Put(kDynamics2dVersion);
  // Mirrors come first, since the world is built from them.
  for (const Mirror& mirror : mirrors_)
  {
    const std::vector<Vector2>& outline = world_->OutlineOf(mirror.body);
    state.Put(static_cast<std::uint8_t>(outline.size()));
    for (const Vector2& point : outline)
    {
      state.Put(point.x());
      state.Put(point.y());
    }
  }
  world_->SaveState(state);
  for (const Owned& owned : owned_)
  {
    state.Put(owned.stance.height);
    state.Put(owned.stance.lean.w());
    state.Put(owned.stance.lean.x());
    state.Put(owned.stance.lean.y());
    state.Put(owned.stance.lean.z());
  }
  for (const Mirror& mirror : mirrors_)
  {
    state.Put(static_cast<std::uint8_t>(mirror.seen ? 1 : 0));
    state.Put(mirror.previous);
  }
  robots_.SaveState(state);
}

void CDynamics2dEngine::LoadState(ByteReader& state)
{
  if (state.Get<std::uint32_t>() != kDynamics2dVersion)
    throw std::runtime_error("saved state of dynamics2d: it is of another version of the engine");
  for (const Mirror& mirror : mirrors_)
  {
    const std::size_t size = world_->OutlineOf(mirror.body).size();
    std::vector<Vector2> outline(state.Get<std::uint8_t>());
    if ((size == 0) != outline.empty() || (size > 0 && outline.size() < 3) || outline.size() > kMostCorners)
      throw std::runtime_error("saved state of dynamics2d: a mirror has an outline that it cannot have");
    for (Vector2& point : outline)
    {
      point.x() = state.Get<double>();
      point.y() = state.Get<double>();
    }
    world_->SetOutline(mirror.body, outline, 0);
  }
  world_->LoadState(state);
  for (Owned& owned : owned_)
  {
    owned.stance.height = state.Get<double>();
    owned.stance.lean.w() = state.Get<double>();
    owned.stance.lean.x() = state.Get<double>();
    owned.stance.lean.y() = state.Get<double>();
    owned.stance.lean.z() = state.Get<double>();
  }
  for (Mirror& mirror : mirrors_)
  {
    mirror.seen = state.Get<std::uint8_t>() != 0;
    mirror.previous = state.Get<PlanePose>();
  }
  robots_.LoadState(state);
}

std::unique_ptr<EngineRegion> CDynamics2dEngine::MakeRegion(unsigned /*region*/, RegionExchange& /*exchange*/)
{
  return std::make_unique<GroupRegion>();
}

void CDynamics2dEngine::Canonicalise() { world_->Rebuild(); }

void CDynamics2dEngine::BeginAgain()
{
  for (const Footbot& footbot : footbots_)
    world_->SetTurretAngle(footbot.body, space_->Attributes()[footbot.turret_slot]);
  // A pose or stance computed from a pose of the space is rounded. If it is nearly the first one, it becomes the first
  // one to the last bit.
  constexpr double kSame = 1e-12;
  for (const Owned& owned : owned_)
  {
    const PlanePose pose = world_->PoseOf(owned.body);
    const PlanePose& first = owned.first_pose;
    if (std::abs(pose.u - first.u) < kSame && std::abs(pose.v - first.v) < kSame &&
        std::abs(WrapAngle(pose.heading - first.heading)) < kSame)
      world_->Place(owned.body, first);
  }
  for (Owned& owned : owned_)
    if (std::abs(owned.stance.height - owned.first_stance.height) < kSame &&
        1 - std::abs(owned.stance.lean.dot(owned.first_stance.lean)) < kSame)
      owned.stance = owned.first_stance;
  world_->BeginAgain();
}

std::string CDynamics2dEngine::StatusText() const
{
  return fmt::format("{} contacts, {} grips, {} groups, {} of {} bodies isolated", world_->ContactCount(),
                     world_->GripCount(), world_->GroupCount(), world_->IsolatedCount(), owned_.size());
}

CPhysicsEngine* MakeDynamics2d() { return new CDynamics2dEngine; }

}  // namespace swarmanoid
