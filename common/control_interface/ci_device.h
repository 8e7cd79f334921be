// CCI_Sensor and CCI_Actuator: a set of devices of one type on one robot, as a controller sees them.
//
// The label of a type, by which the experiment file and controllers name it, is the name of its header without ci_,
// _sensor and _actuator: footbot/ci_footbot_wheels_actuator.h declares the actuator "footbot_wheels".
#pragma once

#include <string>
#include <vector>

namespace swarmanoid
{

// One value of a device as people are shown it.
struct CCI_Reading
{
  std::string name;  // "left", "7"
  // "m/s", "rad"; empty for plain numbers. "colour": 0xRRGGBB, 0 is off. "yes/no": 1 or 0.
  std::string unit;
  double value = 0;
};

// Base of all sensor interfaces. Readings in a control step are those of its start, whenever they are asked for.
class CCI_Sensor
{
public:
  virtual ~CCI_Sensor() = default;
  // For people who watch the robot: appends the present readings. Never called if nobody watches.
  virtual void Describe(std::vector<CCI_Reading>&) const {}
};

// Base of all actuator interfaces. Values set in a control step take effect when it ends, and stay until set again.
class CCI_Actuator
{
public:
  virtual ~CCI_Actuator() = default;
  // For people who watch the robot: appends the values set last. Never called if nobody watches.
  virtual void Describe(std::vector<CCI_Reading>&) const {}
};

}  // namespace swarmanoid

using swarmanoid::CCI_Actuator;
using swarmanoid::CCI_Reading;
using swarmanoid::CCI_Sensor;
