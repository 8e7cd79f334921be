// Checkpoints of the dynamics3d engine.
#include <stdexcept>

#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kDynamics3dVersion = 5;

}  // namespace

using namespace dynamics3d;

void CDynamics3dEngine::SaveState(ByteWriter& state) const
{
  state.Put(kDynamics3dVersion);
  links_->Save(state);
  state.Put(static_cast<std::uint64_t>(world_->BodyCount()));
  for (int number = 0; number < static_cast<int>(world_->BodyCount()); ++number)
    SaveMotion(world_->Body(number), state);
  for (const int object : world_->Objects()) SaveRest(world_->RestOf(object), state);
  for (const auto& model : models_) model->Save(state);
}

void CDynamics3dEngine::LoadState(ByteReader& state)
{
  if (state.Get<std::uint32_t>() != kDynamics3dVersion)
    throw std::runtime_error("saved state: it is of another version of dynamics3d");
  links_->Load(state);
  if (state.Get<std::uint64_t>() != world_->BodyCount())
    throw std::runtime_error("saved state: it is of another experiment");
  for (int number = 0; number < static_cast<int>(world_->BodyCount()); ++number)
    LoadMotion(world_->Body(number), state);
  for (const int object : world_->Objects()) world_->SetRest(object, LoadRest(state));
  for (const auto& model : models_) model->Load(state);
}

}  // namespace swarmanoid
