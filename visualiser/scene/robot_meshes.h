// The meshes of the robots' parts, at a level of detail (0 near .. 2 far). Used by meshes.cpp.
#pragma once

#include <numbers>

#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

inline constexpr float kPiF = std::numbers::pi_v<float>;

Mesh FootbotBaseMesh(int level);
Mesh FootbotTurretMesh(int level);
Mesh FootbotJawMesh(int level);
Mesh EyebotBodyMesh(int level);
Mesh EyebotRotorMesh(int level);
Mesh HandbotBodyMesh(int level);
Mesh HandbotHeadMesh(int level);
Mesh HandbotArmMesh(int level);
Mesh HandbotFingerMesh(int level);

}  // namespace swarmanoid
