// Positions, orientations and poses, in metres and unit quaternions. Used everywhere, in every process.
#pragma once

#include <Eigen/Geometry>

namespace swarmanoid
{

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Quaternion = Eigen::Quaterniond;

// A rigid transform: the position (m) and orientation of a frame within another one.
struct Pose
{
  Vector3 position = Vector3::Zero();
  Quaternion orientation = Quaternion::Identity();

  // Maps a point of this frame to the outer frame.
  Vector3 Apply(const Vector3& local) const { return position + orientation * local; }
  // Returns this pose, followed by a pose given in its frame.
  Pose Compose(const Pose& local) const { return {Apply(local.position), orientation * local.orientation}; }
  Pose Inverse() const
  {
    const Quaternion inverse = orientation.conjugate();
    return {inverse * -position, inverse};
  }
};

// Euler angles (radians) of the experiment files and tables: alpha about x, beta about y, gamma about z,
// applied in the order alpha, beta, gamma about the fixed axes of the space.
struct EulerAngles
{
  double alpha = 0;
  double beta = 0;
  double gamma = 0;
};

Quaternion QuaternionFromEuler(const EulerAngles& angles);
EulerAngles EulerFromQuaternion(const Quaternion& orientation);
// Returns the heading (radians, -pi..pi) of an orientation: its gamma.
double YawOf(const Quaternion& orientation);
Quaternion QuaternionFromYaw(double yaw);

}  // namespace swarmanoid
