// The two arms of a handbot and the wrists at their ends.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotArmsActuator : public CCI_ActuatorOf<CCI_HandBotArmsActuator>
{
public:
  // Angular velocities are in rad/s and clamped to MAX_SPEED. NaN ends a simulation with an error. An arm opens from 0
  // (along the robot) to MAX_ARM, and a wrist turns from 0 to MAX_WRIST (ARGoS 2, hand-bot). The joints stop at these
  // limits.
  static constexpr double MAX_ARM = 1.0471975511965976;    // 60 degrees
  static constexpr double MAX_WRIST = 1.5707963267948966;  // 90 degrees
  static constexpr double MAX_SPEED = 3;                   // rad/s
  // Group-level form: {left arm, right arm, left wrist, right wrist}.
  void SetAllActuatorOutputs(const double (&velocities)[4])
  {
    SetArmVelocities(velocities[0], velocities[1]);
    SetWristVelocities(velocities[2], velocities[3]);
  }
  // Sets the angular velocities of both arms, rad/s. Positive values open an arm.
  virtual void SetArmVelocities(double left, double right) = 0;
  // Sets the angular velocities of both wrists, rad/s.
  virtual void SetWristVelocities(double left, double right) = 0;

  static void Declare(Declaration& columns)
  {
    columns.Set({{"left arm", "rad/s"}, {"right arm", "rad/s"}, {"left wrist", "rad/s"}, {"right wrist", "rad/s"}},
                [](CCI_HandBotArmsActuator& it, std::span<const double> values)
                {
                  it.SetArmVelocities(values[0], values[1]);
                  it.SetWristVelocities(values[2], values[3]);
                });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotArmsActuator;
