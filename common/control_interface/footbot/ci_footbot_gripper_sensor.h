// What the gripper of a footbot does: its aperture and whether it holds something.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotGripperSensor : public CCI_Sensor
{
public:
  // Radians; 0 while nothing was ever gripped.
  virtual double GetAperture() const = 0;
  virtual bool IsGripping() const = 0;

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"aperture", "rad", GetAperture()});
    readings.push_back({"grips", "yes/no", IsGripping() ? 1.0 : 0.0});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotGripperSensor;
