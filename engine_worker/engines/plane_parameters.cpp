#include "engine_worker/engines/plane_parameters.h"

#include "common/math/elementary.h"

namespace swarmanoid
{

std::vector<ParameterSpec> PlaneParameters()
{
  return {{.name = "perpendicular_axis",
           .type = ParameterType::kChoice,
           .default_value = "z",
           .description = "The axis of the space to which the plane of the engine is perpendicular.",
           .choices = {"x", "y", "z"}},
          {.name = "distance",
           .unit = "m",
           .default_value = "0",
           .description = "Signed distance of the plane from the origin along that axis."},
          {.name = "tilt",
           .type = ParameterType::kVector3,
           .unit = "deg",
           .default_value = "0, 0, 0",
           .description = "Turns the plane about the origin of the space: rotations about x, y and z, in this order."}};
}

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
