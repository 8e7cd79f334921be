// CCI_BatterySensor: the remaining charge of a robot's battery.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_BatterySensor : public CCI_SensorOf<CCI_BatterySensor>
{
public:
  // Returns the charge: 1 is full, 0 is empty.
  virtual double GetCharge() const = 0;
  // Returns how long the charge lasts, in s, if it falls as in the last tick. It is infinite if the charge did not
  // fall.
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
