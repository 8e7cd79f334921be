#include "common/math/pose.h"

#include "common/math/elementary.h"

namespace swarmanoid
{

Quaternion QuaternionFromEuler(const EulerAngles& angles)
{
  const SinCos a = SinCosOf(angles.alpha / 2);
  const SinCos b = SinCosOf(angles.beta / 2);
  const SinCos g = SinCosOf(angles.gamma / 2);
  return Quaternion(g.cos * b.cos * a.cos + g.sin * b.sin * a.sin, g.cos * b.cos * a.sin - g.sin * b.sin * a.cos,
                    g.cos * b.sin * a.cos + g.sin * b.cos * a.sin, g.sin * b.cos * a.cos - g.cos * b.sin * a.sin);
}

EulerAngles EulerFromQuaternion(const Quaternion& q)
{
  EulerAngles angles;
  const double sin_beta = 2 * (q.w() * q.y() - q.z() * q.x());
  angles.beta = Asin(sin_beta);
  if (sin_beta > 0.999999999 || sin_beta < -0.999999999)
  {
    // In gimbal lock only the sum or the difference of alpha and gamma is defined; all of it goes to gamma.
    angles.gamma = Atan2(2 * (q.w() * q.z() - q.x() * q.y()), 1 - 2 * (q.x() * q.x() + q.z() * q.z()));
    return angles;
  }
  angles.alpha = Atan2(2 * (q.w() * q.x() + q.y() * q.z()), 1 - 2 * (q.x() * q.x() + q.y() * q.y()));
  angles.gamma = YawOf(q);
  return angles;
}

double YawOf(const Quaternion& q)
{
  return Atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
}

Quaternion QuaternionFromYaw(double yaw)
{
  const SinCos half = SinCosOf(yaw / 2);
  return Quaternion(half.cos, 0, 0, half.sin);
}

}  // namespace swarmanoid
