// An eyebot flies by its propellers, at a velocity or to a position.
#pragma once

#include <optional>
#include <vector>

#include "common/control_interface/ci_device.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CCI_EyeBotPropellersActuator : public CCI_ActuatorOf<CCI_EyeBotPropellersActuator>
{
public:
  // Sets the velocity in the frame of the robot: forward, left, up in m/s; yaw rate in rad/s, positive
  // counter-clockwise. Values are clamped to the limits of the implementation. NaN ends a simulation with an error.
  // Two-dimensional engines ignore `up`.
  virtual void SetVelocity(double forward, double left, double up, double yaw_rate) = 0;
  // Flies to a position (m, in the space) and a heading (radians) and hovers there until the next command. A value that
  // is not finite ends a simulation with an error. Implementations without position control throw CCI_DeviceError.
  virtual void SetPosition(const Vector3& position, double yaw) = 0;
  void Hover() { SetVelocity(0, 0, 0, 0); }
  // Position control flies to this target.
  struct Target
  {
    double x_m, y_m, z_m, yaw_rad;
  };
  // Returns the target of position control; empty if the robot flies by velocity.
  virtual std::optional<Target> GetTarget() const { return std::nullopt; }

  static void Declare(Declaration& columns)
  {
    const auto shown = [](const char* name, const char* unit)
    { return CCI_Column{.name = name, .unit = unit, .audience = CCI_Column::For::kPeople}; };
    columns
        .Set({{"forward", "m/s"}, {"left", "m/s"}, {"up", "m/s"}, {"yaw rate", "rad/s"}},
             &CCI_EyeBotPropellersActuator::SetVelocity)
        .AddEach(
            [](const CCI_EyeBotPropellersActuator& propellers)
            {
              const std::optional<Target> target = propellers.GetTarget();
              return target ? std::vector<Target>{*target} : std::vector<Target>{};
            },
            CCI_Field(shown("target x", "m"), &Target::x_m), CCI_Field(shown("target y", "m"), &Target::y_m),
            CCI_Field(shown("target z", "m"), &Target::z_m), CCI_Field(shown("target yaw", "rad"), &Target::yaw_rad));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotPropellersActuator;
