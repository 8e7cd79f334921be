// Makes a camera for tests from its position and the point that it looks at.
#pragma once

#include <cmath>

#include "common/math/elementary.h"
#include "visualiser/scene/camera.h"

namespace swarmanoid
{

inline Camera LookAt(const Vector3& from, const Vector3& at)
{
  Camera camera;
  camera.position = from;
  const Vector3 to = at - from;
  const double flat = std::hypot(to.x(), to.y());
  if (flat > 0) camera.heading = RadiansToDegrees(std::atan2(to.y(), to.x()));
  if (flat > 0 || to.z() != 0) camera.pitch = RadiansToDegrees(std::atan2(to.z(), flat));
  return camera;
}

}  // namespace swarmanoid
