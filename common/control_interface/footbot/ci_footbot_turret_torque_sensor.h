// The sensor measures the torque and the pull between the body and the turret of a footbot, by which other robots drag
// a gripped object.
#pragma once

#include <array>
#include <span>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_FootBotTurretTorqueSensor : public CCI_SensorOf<CCI_FootBotTurretTorqueSensor>
{
public:
  // Returns {pull along the turret's front, pull to its left, torque about the vertical, counter-clockwise}. The
  // gripped object exerts them on the turret; they are means over the last tick. Each is a fraction, -1..1, of the
  // sensor's range, which depends on the engine (docs/engines.md).
  virtual std::span<const double, 3> GetAllSensorReadings() const = 0;
  double GetForwardTraction() const { return GetAllSensorReadings()[0]; }
  double GetLeftTraction() const { return GetAllSensorReadings()[1]; }
  double GetTorque() const { return GetAllSensorReadings()[2]; }

  static void Declare(Declaration& columns)
  {
    columns.AddAll({{"forward traction", "", -1, 1}, {"left traction", "", -1, 1}, {"torque", "", -1, 1}},
                   &CCI_FootBotTurretTorqueSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotTurretTorqueSensor;
