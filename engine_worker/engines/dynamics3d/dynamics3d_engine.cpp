#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/space/space.h"
#include "engine_worker/engines/dynamics3d/footbot.h"
#include "engine_worker/engines/dynamics3d/handbot.h"
#include "engine_worker/engines/dynamics3d/jointed.h"
#include "engine_worker/engines/dynamics3d/propelled.h"
#include "engine_worker/engines/dynamics3d/wheeled.h"
#include "engine_worker/volume_members.h"

namespace swarmanoid
{

using namespace dynamics3d;

void CDynamics3dEngine::Init(const EngineSetup& setup)
{
  space_ = &setup.space;
  layout_ = &setup.layout;
  configuration_ = &setup.configuration;
  settings_ = SettingsFrom(setup.parameters);

  const double tick = space_->GetTickSeconds();
  const double per_tick = std::ceil(tick / settings_.step_seconds - 1e-9);
  steps_ = std::max(1, static_cast<int>(per_tick)) * std::max(1, setup.configuration.subclock);
  step_seconds_ = tick / steps_;

  const Frame frame(settings_.frame);
  dynamics3d::WorldSettings world = settings_.world;
  world.gravity = frame.VectorToLocal(world.gravity);
  world_ = std::make_unique<OdeWorld>(world);
  links_ = std::make_unique<LinkTable>(*world_);
  scene_ = std::make_unique<Scene>(Scene{.world = *world_,
                                         .links = *links_,
                                         .space = *space_,
                                         .frame = frame,
                                         .up = frame.VectorToLocal(Vector3::UnitZ()),
                                         .tick_seconds = tick,
                                         .density = settings_.density,
                                         .time_s = 0,
                                         .wind = Wind(space_->GetExperiment()),
                                         .models = {}});
  scene_->models.assign(space_->Size(), nullptr);

  groups_ = std::make_unique<SolverGroups>(*scene_, steps_, step_seconds_, settings_.solve_all);
  const auto threads = static_cast<unsigned>(setup.parameters.Integer("threads"));
  if (threads == 0)
    groups_->UseThreads(setup.threads, setup.pool);
  else
    groups_->UseThreads(threads, nullptr);
  if (setup.team != nullptr) groups_->UseRegions(*setup.team);

  AddGround();
  if (settings_.arena_walls) AddArenaWalls();
}

double CDynamics3dEngine::CeilingHeight() const
{
  const double height = space_->GetExperiment().arena_size.z();
  return settings_.ceiling && height > 0 ? height : std::numeric_limits<double>::infinity();
}

void CDynamics3dEngine::AddGround()
{
  world_->BeginEntity(kNoEntity);
  if (settings_.ground) world_->AddSolid(dCreatePlane(nullptr, 0, 0, 1, 0), -1, ELayer::kStatic, ESurface::kGround);
  const double ceiling = CeilingHeight();
  if (std::isinf(ceiling)) return;
  const Vector3 down = -scene_->up;
  const Vector3 point = scene_->frame.PointToLocal({0, 0, ceiling});
  world_->AddSolid(dCreatePlane(nullptr, down.x(), down.y(), down.z(), down.dot(point)), -1, ELayer::kStatic);
}

void CDynamics3dEngine::AddArenaWalls()
{
  const Vector3& size = space_->GetExperiment().arena_size;
  for (const int axis : {0, 1})
  {
    for (const double side : {1.0, -1.0})
    {
      Vector3 inwards = Vector3::Zero();
      inwards[axis] = side;
      Vector3 corner = Vector3::Zero();
      corner[axis] = side > 0 ? 0 : size[axis];
      const Vector3 normal = scene_->frame.VectorToLocal(inwards);
      const double distance = normal.dot(scene_->frame.PointToLocal(corner));
      world_->AddSolid(dCreatePlane(nullptr, normal.x(), normal.y(), normal.z(), distance), -1, ELayer::kStatic);
    }
  }
}

std::unique_ptr<Model> CDynamics3dEngine::MakeModel(const CSwarmanoidSpaceEntity& entity)
{
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  switch (kind.mechanism)
  {
    case Mechanism::kTurretGripper:
      return std::make_unique<FootbotModel>(*scene_, entity);
    case Mechanism::kArms:
      return std::make_unique<HandbotModel>(*scene_, entity);
    case Mechanism::kPropellers:
    case Mechanism::kNone:
      break;
  }
  if (kind.base) return std::make_unique<JointedModel>(*scene_, entity);
  if (kind.propellers) return std::make_unique<PropelledModel>(*scene_, entity, CeilingHeight());
  if (kind.wheels) return std::make_unique<WheeledModel>(*scene_, entity, WheeledShape::Of(entity, scene_->density));
  return std::make_unique<ObjectModel>(*scene_, entity);
}

void CDynamics3dEngine::AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding)
{
  const EntityRole role = DescriptionOf(entity.GetKind()).role;
  if (role == EntityRole::kHole) holes_.push_back(&entity);
  if (role == EntityRole::kTerrain) AddTerrain(entity);
  if (!HasBody(entity.GetKind())) return;
  if (binding == EBinding::kFixed)
  {
    AddStaticObject(*scene_, entity);
    return;
  }
  if (binding == EBinding::kMirror)
  {
    auto mirror = std::make_unique<MirrorModel>(*scene_, entity);
    mirrors_.push_back(mirror.get());
    groups_->Add(*mirror, false);
    models_.push_back(std::move(mirror));
  }
  else
  {
    models_.push_back(MakeModel(entity));
    owned_.push_back(models_.back().get());
    groups_->Add(*owned_.back(), true);
    owned_.back()->Place(scene_->frame.ToLocal(entity.GetPose()));
  }
  scene_->models[entity.GetIndex()] = models_.back().get();
}

void CDynamics3dEngine::AddTerrain(const CSwarmanoidSpaceEntity& entity)
{
  const auto terrain = LoadTerrain(entity.GetConfiguration(), space_->GetExperiment().folder);
  const Pose pose = scene_->frame.ToLocal(entity.GetPose());
  const std::uint32_t index = entity.GetIndex();
  if (const auto voxels = std::dynamic_pointer_cast<const VoxelTerrain>(terrain))
    terrains_.push_back(AddVoxels(*world_, index, voxels, pose));
  else if (const auto heights = std::dynamic_pointer_cast<const HeightTerrain>(terrain))
    terrains_.push_back(AddHeightfield(*world_, index, heights, pose));
}

void CDynamics3dEngine::Start()
{
  AddHoles();
  for (const std::uint32_t entity : layout_->changing) MirrorOf(entity).SetLeftOut(true);
  FindActive();
}

MirrorModel& CDynamics3dEngine::MirrorOf(std::uint32_t entity)
{
  return **std::ranges::lower_bound(mirrors_, entity, {}, &Model::Entity);
}

void CDynamics3dEngine::FindActive()
{
  active_.clear();
  std::ranges::copy_if(owned_, std::back_inserter(active_), [](const Model* model) { return !model->IsLeftOut(); });
  groups_->FreeRobots().ConfigureAgain();
}

void CDynamics3dEngine::TakeOver(std::uint32_t entity, const EntityVelocity& velocity)
{
  std::erase(elsewhere_, entity);
  MirrorOf(entity).SetLeftOut(true);
  Model& model = *scene_->models[entity];
  model.SetElsewhere(false);
  model.TakeOver(scene_->frame.ToLocal(space_->GetPose(entity)),
                 {scene_->frame.VectorToLocal(velocity.linear), scene_->frame.VectorToLocal(velocity.angular)});
  FindActive();
}

void CDynamics3dEngine::HandOver(std::uint32_t entity)
{
  links_->RemoveIf(entity, [](const LinkSpec&) { return true; });
  if (!std::ranges::binary_search(elsewhere_, entity))
    elsewhere_.insert(std::ranges::upper_bound(elsewhere_, entity), entity);
  Model& model = *scene_->models[entity];
  model.SetElsewhere(true);
  Park(model);
  MirrorOf(entity).SetLeftOut(false);
  FindActive();
}

// The model waits far away, where no gripper finds it.
void CDynamics3dEngine::Park(Model& model)
{
  const std::uint32_t entity = model.Entity();
  model.Place(scene_->frame.ToLocal(WaitingPose(space_->GetExperiment().entities[entity], entity)));
  model.SetLeftOut(true);
}

// Entities of other engines are ghosts near the volume, and mirrors elsewhere. The mirrors know their velocities.
void CDynamics3dEngine::FollowElsewhere()
{
  bool changed = false;
  for (const std::uint32_t entity : elsewhere_)
  {
    Model& model = *scene_->models[entity];
    MirrorModel& mirror = MirrorOf(entity);
    const bool is_ghost = IsGhost(*space_, configuration_->volume, entity);
    if (is_ghost == model.IsLeftOut())
    {
      changed = true;
      mirror.SetLeftOut(is_ghost);
      if (!is_ghost) Park(model);
    }
    if (is_ghost) model.Haunt(scene_->frame.ToLocal(space_->GetPose(entity)), mirror.Velocity());
  }
  if (changed) FindActive();
}

std::optional<EntityVelocity> CDynamics3dEngine::VelocityOf(std::uint32_t entity) const
{
  const EntityVelocity velocity = scene_->models[entity]->Velocity();
  return EntityVelocity{scene_->frame.VectorToSpace(velocity.linear), scene_->frame.VectorToSpace(velocity.angular)};
}

void CDynamics3dEngine::Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors)
{
  for (MirrorModel* mirror : mirrors_) mirror->Follow();
  FollowElsewhere();
  // Entities outside the arena may have no floor below them, so they are placed again and cannot fall.
  for (Model* model : active_)
    if (const std::uint32_t entity = model->GetSpaceEntity().GetIndex(); !space_->IsPresent(entity))
      model->Place(scene_->frame.ToLocal(space_->GetPose(entity)));
  ApplyCommands(commands);
  scene_->time_s = static_cast<double>(space_->GetTick()) * scene_->tick_seconds;
  for (Model* model : active_) model->BeginTick();
  groups_->Advance(space_->GetTick() * static_cast<std::uint64_t>(steps_));
  WritePoses(update.poses);
  for (const Model* model : active_)
  {
    AttributeReport report(model->GetSpaceEntity(), update.attributes);
    model->Report(report);
  }
  WriteSensors(sensors);
}

void CDynamics3dEngine::ApplyCommands(const EngineCommands& commands)
{
  for (const ChannelBlock& block : commands.blocks)
  {
    const std::span<const double> values = commands.Of(block);
    const auto width = static_cast<std::size_t>(block.width);
    for (std::size_t k = 0; k < block.entities.size(); ++k)
    {
      const std::span<const double> mine = values.subspan(k * width, width);
      if (!std::all_of(mine.begin(), mine.end(), [](double value) { return std::isfinite(value); }))
        throw std::runtime_error(fmt::format("robot '{}' gave {} a value that is not a finite number",
                                             space_->GetEntity(block.entities[k]).GetId(), block.name));
      scene_->models[block.entities[k]]->Command(block.name, mine);
    }
  }
}

void CDynamics3dEngine::WritePoses(std::vector<double>& poses) const
{
  const std::size_t count = owned_.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Pose pose = scene_->frame.ToSpace(owned_[i]->CurrentPose());
    const double values[7] = {pose.position.x(),    pose.position.y(),    pose.position.z(),   pose.orientation.x(),
                              pose.orientation.y(), pose.orientation.z(), pose.orientation.w()};
    for (std::size_t k = 0; k < 7; ++k)
    {
      if (!std::isfinite(values[k]))
        throw std::runtime_error(
            fmt::format("engine '{}': the motion of '{}' has lost all bounds; a shorter step_ms "
                        "or smaller forces may keep it",
                        configuration_->id, owned_[i]->GetSpaceEntity().GetId()));
      poses[k * count + i] = values[k];
    }
  }
}

void CDynamics3dEngine::WriteSensors(std::span<double> sensors) const
{
  for (const ChannelBlock& block : layout_->sensors)
  {
    const auto width = static_cast<std::size_t>(block.width);
    for (std::size_t k = 0; k < block.entities.size(); ++k)
      scene_->models[block.entities[k]]->Sense(block.name, sensors.subspan(block.offset + k * width, width));
  }
}

void CDynamics3dEngine::EntityMoved(std::uint32_t entity)
{
  const bool connected =
      links_->RemoveIf(entity, [&](const LinkSpec& link)
                       { return !JoinsTwoEntities(link) || !space_->Structure().Holds(link.entity_a, link.entity_b); });
  Model* model = scene_->models[entity];
  if (model == nullptr) return;
  const Pose pose = scene_->frame.ToLocal(space_->GetPose(entity));
  if (connected)
    model->Carry(pose);
  else
    model->Place(pose);
}

void CDynamics3dEngine::BeginAgain()
{
  for (Model* model : owned_)
    if (!model->IsElsewhere()) model->BeginAgain();
}

namespace
{

// A region needs no other region.
class GroupRegion final : public StreamedRegion
{
public:
  explicit GroupRegion(SolverGroups& groups) : groups_(groups) {}

private:
  void Execute(std::span<const char> stream, ByteWriter& result) override { groups_.Execute(stream, result); }

  SolverGroups& groups_;
};

}  // namespace

std::unique_ptr<EngineRegion> CDynamics3dEngine::MakeRegion(unsigned /*region*/, RegionExchange& /*exchange*/)
{
  return std::make_unique<GroupRegion>(*groups_);
}

std::string CDynamics3dEngine::StatusText() const
{
  return fmt::format("{} contacts, {} groups, {} grips and ropes, {} objects at rest, {} free robots",
                     groups_->ContactCount(), GroupCount(), links_->Size(), world_->SleeperCount(), FreeRobotCount());
}

CPhysicsEngine* MakeDynamics3d() { return new CDynamics3dEngine; }

}  // namespace swarmanoid
