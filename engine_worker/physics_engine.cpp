#include "engine_worker/physics_engine.h"

#include <stdexcept>

namespace swarmanoid
{

std::unique_ptr<EngineRegion> CPhysicsEngine::MakeRegion(unsigned, RegionExchange&)
{
  throw std::logic_error("the engine is described as one that can be split, and has no MakeRegion");
}

void CPhysicsEngine::TakeOver(std::uint32_t, const EntityVelocity&)
{
  throw std::logic_error("the engine is described as one that hands over entities, and has no TakeOver");
}

void CPhysicsEngine::HandOver(std::uint32_t)
{
  throw std::logic_error("the engine is described as one that hands over entities, and has no HandOver");
}

template <>
PluginRegistry<CPhysicsEngine>& PluginRegistry<CPhysicsEngine>::Instance()
{
  static PluginRegistry registry(PluginKind::kEngine);
  return registry;
}

}  // namespace swarmanoid
