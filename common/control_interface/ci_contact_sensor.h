// Where a robot touches others: a bumper all around it.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_ContactSensor : public CCI_Sensor
{
public:
  // The directions of all that touches the robot, radians, counter-clockwise from the front, -pi..pi; in no particular
  // order, valid until the next control step.
  virtual std::span<const double> GetAllContacts() const = 0;
  bool IsTouched() const { return !GetAllContacts().empty(); }

  // Whether anything touches it.
  std::vector<CCI_Column> Columns() const override { return {{"touched", "yes/no", 0, 1}}; }
  void ReadColumns(std::vector<double>& values) const override { values.push_back(IsTouched() ? 1 : 0); }
  // Where.
  std::vector<CCI_Column> Rows() const override { return {{"direction", "rad"}}; }
  void ReadRows(std::vector<double>& values) const override
  {
    const std::span<const double> all = GetAllContacts();
    values.insert(values.end(), all.begin(), all.end());
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"touched", "yes/no", IsTouched() ? 1.0 : 0.0});
    for (std::size_t i = 0; i < GetAllContacts().size(); ++i)
      readings.push_back({"contact " + std::to_string(i), "rad", GetAllContacts()[i]});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_ContactSensor;
