// The altitude sensor of an eyebot.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_EyeBotAltitudeSensor : public CCI_Sensor
{
public:
  // Metres from the base of the robot down to the first thing of its engines below it: floor, block, robot; never below
  // 0.
  virtual double GetAltitude() const = 0;

  std::vector<CCI_Column> Columns() const override { return {{"altitude", "m", 0}}; }
  void ReadColumns(std::vector<double>& values) const override { values.push_back(GetAltitude()); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotAltitudeSensor;
