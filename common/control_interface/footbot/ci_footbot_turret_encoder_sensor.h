// The angle of the turret of a footbot against its body.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotTurretEncoderSensor : public CCI_Sensor
{
public:
  // Radians, -pi..pi, counter-clockwise from the front.
  virtual double GetTurretAngle() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"angle", "rad", GetTurretAngle()});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretEncoderSensor;
