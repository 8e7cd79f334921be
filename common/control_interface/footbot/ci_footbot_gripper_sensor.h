// The gripper of a footbot: its aperture and the gripped entity.
#pragma once

#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotGripperSensor : public CCI_SensorOf<CCI_FootBotGripperSensor>
{
public:
  static constexpr double OPEN_APERTURE = 1.5707963267948966;  // 90 degrees
  // Returns the aperture in radians, 0 (closed) to OPEN_APERTURE. The gripper is closed until the end of the first
  // control step, when it follows its actuator. Without the actuator it stays closed.
  virtual double GetAperture() const = 0;
  // Returns true while the gripper holds an entity.
  virtual bool IsGripping() const = 0;
  // Returns the id of the gripped entity, or an empty text. Real robots cannot know it, so there it is always empty.
  virtual std::string GetHeldId() const { return {}; }

  static void Declare(Declaration& columns)
  {
    columns.Add({"aperture", "rad", 0, OPEN_APERTURE}, &CCI_FootBotGripperSensor::GetAperture)
        .Add({"gripping", "yes/no", 0, 1}, &CCI_FootBotGripperSensor::IsGripping);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotGripperSensor;
