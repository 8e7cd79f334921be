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

  std::vector<CCI_Column> Columns() const override { return {{"angle", "rad"}}; }
  void ReadColumns(std::vector<double>& values) const override { values.push_back(GetTurretAngle()); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretEncoderSensor;
