// Checkpoints of the dynamics3d engine.
#include <stdexcept>

#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kDynamics3dVersion = 4;

}  // namespace

using namespace dynamics3d;

void CDynamics3dEngine::SaveState(ByteWriter& state) const
{
  state.Put(kDynamics3dVersion);
  links_->Save(state);
  state.Put(static_cast<std::uint64_t>(world_->BodyCount()));
  for (int number = 0; number < static_cast<int>(world_->BodyCount()); ++number)
  {
    const dBodyID body = world_->Body(number);
    state.Put(RawPoseOf(body));
    for (const dReal* velocity : {dBodyGetLinearVel(body), dBodyGetAngularVel(body)})
      for (int k = 0; k < 3; ++k) state.Put(velocity[k]);
  }
  for (const int object : world_->Objects())
  {
    const Rest& rest = world_->RestOf(object);
    state.Put(rest.reference);
    state.Put(rest.steps);
    state.Put(rest.asleep);
  }
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
  {
    const dBodyID body = world_->Body(number);
    SetRawPose(body, state.Get<RawPose>());
    double velocity[6];
    for (double& value : velocity) value = state.Get<double>();
    dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
    dBodySetAngularVel(body, velocity[3], velocity[4], velocity[5]);
  }
  for (const int object : world_->Objects())
  {
    Rest rest;
    rest.reference = state.Get<RawPose>();
    rest.steps = state.Get<std::uint32_t>();
    rest.asleep = state.Get<bool>();
    world_->SetRest(object, rest);
  }
  for (const auto& model : models_) model->Load(state);
}

}  // namespace swarmanoid
