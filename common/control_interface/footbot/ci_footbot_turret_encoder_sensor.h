// The encoder measures the angle of the turret of a footbot against its body.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotTurretEncoderSensor : public CCI_SensorOf<CCI_FootBotTurretEncoderSensor>
{
public:
  // Returns the angle in radians, -pi..pi, counter-clockwise from the front.
  virtual double GetTurretAngle() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"angle", "rad"}, &CCI_FootBotTurretEncoderSensor::GetTurretAngle);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretEncoderSensor;
