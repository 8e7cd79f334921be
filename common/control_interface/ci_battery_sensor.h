// What is left in the battery of a robot.
#pragma once

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_BatterySensor : public CCI_Sensor
{
public:
  // 1 full, 0 empty.
  virtual double GetCharge() const = 0;
  // How long the charge lasts if it goes on falling as in the last tick, s; infinite if it did not fall.
  virtual double GetTimeLeft() const = 0;

  std::vector<CCI_Column> Columns() const override
  {
    return {{"charge", "", 0, 1}, {.name = "time left", .unit = "s", .minimum = 0, .may_be_infinite = true}};
  }
  void ReadColumns(std::vector<double>& values) const override
  {
    values.insert(values.end(), {GetCharge(), GetTimeLeft()});
  }
  void Describe(std::vector<CCI_Reading>& readings) const override { readings.push_back({"charge", "", GetCharge()}); }
};

}  // namespace swarmanoid

using swarmanoid::CCI_BatterySensor;
