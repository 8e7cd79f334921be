// The bodies that the simulator's own engines collide: PluginDescription::collision_model of each engine. Round ends
// count as flat ones.
#pragma once

#include <span>
#include <vector>

#include "common/experiment/collision_body.h"
#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Adds the outlines on the plane, as high as the entity.
void Kinematics2dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                        std::vector<CollisionBody>& bodies);
void Dynamics2dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies);
void Dynamics3dBodies(const EntityConfiguration& entity, std::span<const double> attributes,
                      std::vector<CollisionBody>& bodies);

// Returns the shoulder of an arm (0 left, 1 right) of a handbot, in its frame; x points along the arm. Angles are in
// radians.
Pose HandbotShoulder(std::size_t arm, double head_angle, double aperture);

}  // namespace swarmanoid
