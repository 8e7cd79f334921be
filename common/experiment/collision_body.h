// A body as an engine collides it: what PluginDescription::collision_model gives. Read by sensors, queries and
// renderers, in their processes.
#pragma once

#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

struct CollisionBody
{
  bool is_cylinder = false;             // about its z axis; otherwise a box
  Pose pose;                            // of its centre, in the frame of the entity
  Vector3 half_size = Vector3::Zero();  // m; of a cylinder: radius, radius, half the height
  // Instead of the box, which is about it; in the frame of the entity. The configuration of the entity keeps it.
  const ConvexHull* hull = nullptr;
};

// Adds the plain body of an entity's kind; nothing for those without one.
void AddPlainBody(const EntityConfiguration& entity, std::vector<CollisionBody>& bodies);

}  // namespace swarmanoid
