// A body as an engine collides it: the result of PluginDescription::collision_model. Sensors, queries and renderers
// read it in their processes.
#pragma once

#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

struct CollisionBody
{
  bool is_cylinder = false;             // a cylinder about its z axis; otherwise a box
  Pose pose;                            // the pose of its centre, in the frame of the entity
  Vector3 half_size = Vector3::Zero();  // m; for a cylinder: radius, radius, half the height
  // This convex hull collides instead of the box around it, in the frame of the entity. The configuration of the entity
  // owns it.
  const ConvexHull* hull = nullptr;
};

// Adds the plain body of an entity's kind; nothing for kinds without one.
void AddPlainBody(const EntityConfiguration& entity, std::vector<CollisionBody>& bodies);

}  // namespace swarmanoid
