#include "engine_worker/engines/plane_parameters.h"

#include "common/math/elementary.h"

namespace swarmanoid
{

PlaneFrame PlaneFrom(const Parameters& parameters)
{
  const std::string axis = parameters.Text("perpendicular_axis");
  const PlaneFrame plain(axis == "x"   ? PlaneAxis::kX
                         : axis == "y" ? PlaneAxis::kY
                                       : PlaneAxis::kZ,
                         parameters.Number("distance"));
  const Vector3 tilt = parameters.Vector3Of("tilt");
  if (tilt == Vector3::Zero()) return plain;
  const Quaternion turn =
      QuaternionFromEuler({DegreesToRadians(tilt.x()), DegreesToRadians(tilt.y()), DegreesToRadians(tilt.z())});
  return PlaneFrame(Pose{Vector3::Zero(), turn}.Compose(plain.Frame()));
}

}  // namespace swarmanoid
