// What the simulator's own engines collide: PluginDescription::collision_model of each. Round ends count as flat ones.
#pragma once

#include <span>
#include <vector>

#include "common/experiment/collision_body.h"
#include "common/experiment/experiment.h"

namespace swarmanoid
{

// The outlines on the plane, as high as the entity.
void Kinematics2dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                        std::vector<CollisionBody>& bodies);
void Dynamics2dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies);
void Dynamics3dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies);

// The shoulder of an arm (0 left, 1 right) of a handbot, in its frame; x points along the arm. Radians.
Pose HandbotShoulder(std::size_t arm, double head_angle, double aperture);

}  // namespace swarmanoid
