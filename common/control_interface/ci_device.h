// CCI_Sensor and CCI_Actuator: a set of devices of one type on one robot, as a controller sees them.
#pragma once

namespace swarmanoid
{

// Base of all sensor interfaces. Readings are those of the start of the control step.
class CCI_Sensor
{
public:
  virtual ~CCI_Sensor() = default;
};

// Base of all actuator interfaces. Values set in a control step take effect when it ends, and stay until set again.
class CCI_Actuator
{
public:
  virtual ~CCI_Actuator() = default;
};

}  // namespace swarmanoid

using swarmanoid::CCI_Actuator;
using swarmanoid::CCI_Sensor;
