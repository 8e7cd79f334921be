#include "controller_host/devices/sensor_world.h"

#include <map>
#include <mutex>

namespace swarmanoid
{

SensorWorld::SensorWorld(const CSwarmanoidSpace& space)
    : space_(space), shapes_(ShapesOf(space)), membership_(space.GetExperiment()), grid_(space, shapes_)
{
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

void SensorWorld::Refresh(std::uint64_t& seen)
{
  if (generation_ == 0 || tick_ != space_.GetTick() || seen == generation_ || seen == 0)
  {
    grid_.Rebuild();
    tick_ = space_.GetTick();
    ++generation_;
  }
  seen = generation_;
}

}  // namespace swarmanoid
