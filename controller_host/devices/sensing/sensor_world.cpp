#include "controller_host/devices/sensing/sensor_world.h"

#include <map>
#include <mutex>

#include "common/math/random.h"

namespace swarmanoid
{

SensorWorld::SensorWorld(const CSwarmanoidSpace& space)
    : space_(space),
      bodies_(BodiesOf(space)),
      membership_(space.GetExperiment()),
      grid_(space, bodies_),
      fixed_(space, bodies_, 0),
      terrain_(space),
      revision_(space.Revision() - 1)
{
  for (const BodyShape& body : bodies_)
    extents_.push_back(
        {static_cast<float>(body.radius), static_cast<float>(body.low), static_cast<float>(body.high), body.kind});
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

void SensorWorld::Refresh()
{
  if (revision_ == space_.Revision()) return;
  revision_ = space_.Revision();
  grid_.Rebuild();
}

}  // namespace swarmanoid
