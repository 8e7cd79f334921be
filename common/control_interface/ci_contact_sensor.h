// CCI_ContactSensor: a bumper all around a robot, which tells where the robot touches other bodies.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_ContactSensor : public CCI_SensorOf<CCI_ContactSensor>
{
public:
  // Returns the directions of all that touches the robot, radians, counter-clockwise from the front, -pi..pi; in no
  // particular order, valid until the next control step.
  virtual std::span<const double> GetAllContacts() const = 0;
  bool IsTouched() const { return !GetAllContacts().empty(); }

  static void Declare(Declaration& columns)
  {
    columns.Add({"touched", "yes/no", 0, 1}, &CCI_ContactSensor::IsTouched)
        .AddRows("contact", &CCI_ContactSensor::GetAllContacts, CCI_Field({"direction", "rad"}, std::identity()));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_ContactSensor;
