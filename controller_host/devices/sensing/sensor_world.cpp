#include "controller_host/devices/sensing/sensor_world.h"

#include <map>
#include <mutex>

#include "common/math/random.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Articulated bodies must not be treated as simple cylinders.
BodyShapes SensedBodies(const CSwarmanoidSpace& space, const CollisionModels& models)
{
  BodyShapes bodies(space);
  for (const std::uint32_t entity : models.Articulated())
  {
    BodyShape& body = bodies.MakeOwn(entity);
    body.kind = Shape::Kind::kBox;
    body.FindExtent();
  }
  return bodies;
}

}  // namespace

SensorWorld::SensorWorld(const CSwarmanoidSpace& space)
    : space_(space),
      models_(space),
      bodies_(SensedBodies(space, models_)),
      membership_(space.GetExperiment()),
      grid_(space, bodies_),
      moved_(space, grid_.Bodies()),
      fixed_(space, bodies_, 0),
      terrain_(space),
      revision_(space.Revision() - 1)
{
  parts_.resize(models_.Articulated().size());
  if (!parts_.empty()) parts_of_.assign(space.Size(), -1);
  for (std::size_t k = 0; k < parts_.size(); ++k) parts_of_[models_.Articulated()[k]] = static_cast<std::int32_t>(k);
}

std::shared_ptr<SensorWorld> SensorWorld::Of(const CSwarmanoidSpace& space)
{
  static std::mutex mutex;
  static std::map<const CSwarmanoidSpace*, std::weak_ptr<SensorWorld>> worlds;
  const std::lock_guard lock(mutex);
  std::erase_if(worlds, [](const auto& entry) { return entry.second.expired(); });
  std::shared_ptr<SensorWorld> world = worlds[&space].lock();
  if (world == nullptr)
  {
    world = std::make_shared<SensorWorld>(space);
    worlds[&space] = world;
  }
  return world;
}

std::span<const std::uint64_t> SensorWorld::Names()
{
  if (names_.empty())
    for (std::uint32_t entity = 0; entity < space_.Size(); ++entity)
      names_.push_back(StreamName(space_.GetEntity(entity).GetId()));
  return names_;
}

void SensorWorld::Refresh(WorkerPool* pool)
{
  if (revision_ == space_.Revision()) return;
  revision_ = space_.Revision();
  MoveParts();
  grid_.Rebuild(pool);
}

// The grid has them with all that they reach.
void SensorWorld::MoveParts()
{
  for (std::size_t k = 0; k < parts_.size(); ++k)
  {
    const std::uint32_t entity = models_.Articulated()[k];
    models_.BodiesOf(entity, parts_[k]);
    BodyShape& body = bodies_.OwnOf(entity);
    body.radius = 0;
    for (const CollisionBody& part : parts_[k]) body.radius = std::max(body.radius, ReachOf(part));
    body.low = -body.radius;
    body.high = body.radius;
    body.FindExtent();
  }
}

}  // namespace swarmanoid
