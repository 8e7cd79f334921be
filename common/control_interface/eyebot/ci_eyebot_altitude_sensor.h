// The altitude sensor of an eyebot.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotAltitudeSensor : public CCI_SensorOf<CCI_EyeBotAltitudeSensor>
{
public:
  // Metres from the base of the robot down to the first thing of its engines below it: floor, block, robot; never below
  // 0.
  virtual double GetAltitude() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"altitude", "m", 0}, &CCI_EyeBotAltitudeSensor::GetAltitude);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotAltitudeSensor;
