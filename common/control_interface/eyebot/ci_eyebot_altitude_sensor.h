// The altitude sensor of an eyebot measures how far the robot is above the floor or a body.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotAltitudeSensor : public CCI_SensorOf<CCI_EyeBotAltitudeSensor>
{
public:
  // Returns the distance in metres from the base of the robot down to the first floor, block or robot of its engines.
  // It is never below 0.
  virtual double GetAltitude() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"altitude", "m", 0}, &CCI_EyeBotAltitudeSensor::GetAltitude);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotAltitudeSensor;
