// What the gripper of a footbot does: its aperture, and what it holds.
#pragma once

#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotGripperSensor : public CCI_SensorOf<CCI_FootBotGripperSensor>
{
public:
  static constexpr double OPEN_APERTURE = 1.5707963267948966;  // 90 degrees
  // Radians, 0 (closed) to OPEN_APERTURE. The gripper is closed until the end of the first control step, when it does
  // what its actuator is told; without the actuator it stays so.
  virtual double GetAperture() const = 0;
  virtual bool IsGripping() const = 0;
  // The id of the entity that it holds, empty for none. Real robots cannot tell: there it is always empty.
  virtual std::string GetHeldId() const { return {}; }

  static void Declare(Declaration& columns)
  {
    columns.Add({"aperture", "rad", 0, OPEN_APERTURE}, &CCI_FootBotGripperSensor::GetAperture)
        .Add({"gripping", "yes/no", 0, 1}, &CCI_FootBotGripperSensor::IsGripping);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotGripperSensor;
