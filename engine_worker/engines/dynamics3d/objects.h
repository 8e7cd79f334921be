// Blocks, walls, preys and mirrors: things without control. Static ones are solids without a body.
#pragma once

#include "engine_worker/engines/dynamics3d/model.h"

namespace swarmanoid::dynamics3d
{

// A movable block or a prey.
class ObjectModel : public Model
{
public:
  ObjectModel(Scene& scene, const CSwarmanoidSpaceEntity& entity);
};

// A movable entity of another engine: follows the space with its speed there, pushes and is not pushed.
class MirrorModel : public Model
{
public:
  MirrorModel(Scene& scene, const CSwarmanoidSpaceEntity& entity);
  // Moves to where the space has it; the speed is what led there in a tick's time.
  void Follow();
  void Save(ByteWriter& state) const override { state.Put(last_); }
  void Load(ByteReader& state) override { last_ = state.Get<RawPose>(); }

private:
  RawPose last_;  // of the tick before
};

// A block, wall, or any other entity that never moves.
void AddStaticObject(Scene& scene, const CSwarmanoidSpaceEntity& entity);

}  // namespace swarmanoid::dynamics3d
