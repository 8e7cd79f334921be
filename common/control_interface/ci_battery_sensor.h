// CCI_BatterySensor: the remaining charge of a robot's battery.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_BatterySensor : public CCI_SensorOf<CCI_BatterySensor>
{
public:
  // 1 full, 0 empty.
  virtual double GetCharge() const = 0;
  // How long the charge lasts if it goes on falling as in the last tick, s; infinite if it did not fall.
  virtual double GetTimeLeft() const = 0;

  static void Declare(Declaration& columns)
  {
    columns.Add({"charge", "", 0, 1}, &CCI_BatterySensor::GetCharge)
        .Add({.name = "time left", .unit = "s", .minimum = 0, .may_be_infinite = true},
             &CCI_BatterySensor::GetTimeLeft);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_BatterySensor;
