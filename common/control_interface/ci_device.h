// CCI_Sensor and CCI_Actuator: a set of devices of one type on one robot, as a controller sees them.
//
// The label of a type, by which the experiment file and controllers name it, is the name of its header without ci_,
// _sensor and _actuator: footbot/ci_footbot_wheels_actuator.h declares the actuator "footbot_wheels".
#pragma once

#include <limits>
#include <span>
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

// One of the numbers that a device reads or is told, as a column of a table. It is the same at every tick, and for all
// robots that carry the device alike.
struct CCI_Column
{
  std::string name;    // "left", "7"
  std::string unit{};  // as in CCI_Reading
  // What the values lie between, noise included.
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool may_be_infinite = false;  // infinity is a reading, too: nothing was found
};

// Columns <prefix>0, <prefix>1 and so on, in all else like `like`.
std::vector<CCI_Column> NumberedColumns(std::size_t count, const std::string& prefix = "", CCI_Column like = {});

// Base of all sensor interfaces. Readings in a control step are those of its start, whenever they are asked for.
//
// An interface states its readings as columns of numbers, so that programs can read every sensor in the same way: the
// arrays of Python, tables, tests. The sensor of a user states its own by overriding Columns and ReadColumns, or Rows
// and ReadRows.
class CCI_Sensor
{
public:
  virtual ~CCI_Sensor() = default;
  // The readings that every tick has. Empty: there are none.
  virtual std::vector<CCI_Column> Columns() const { return {}; }
  // Appends one number for each column.
  virtual void ReadColumns(std::vector<double>&) const {}
  // The readings whose number differs from tick to tick, such as blobs or packets: the columns of one of them.
  virtual std::vector<CCI_Column> Rows() const { return {}; }
  // Appends row after row, each with one number for each column of Rows().
  virtual void ReadRows(std::vector<double>&) const {}
  // Appends the ids of the entities that the rows are about, one for each row. Nothing if the sensor does not tell.
  virtual void ReadRowIds(std::vector<std::string>&) const {}
  // For people who watch the robot: appends the present readings. Never called if nobody watches. These are the columns
  // unless the sensor overrides it.
  virtual void Describe(std::vector<CCI_Reading>& readings) const;
};

// Base of all actuator interfaces. Values set in a control step take effect when it ends, and stay until set again.
class CCI_Actuator
{
public:
  virtual ~CCI_Actuator() = default;
  // The numbers that the actuator can be told by SetColumns. Empty: there are none.
  virtual std::vector<CCI_Column> Columns() const { return {}; }
  // Sets all columns at once. `values` has a finite number for each of them; what is beyond a range is cut to it.
  // Switches are on above 0.5.
  virtual void SetColumns(std::span<const double>) {}
  // For people who watch the robot: appends the values set last. Never called if nobody watches.
  virtual void Describe(std::vector<CCI_Reading>&) const {}
};

}  // namespace swarmanoid

using swarmanoid::CCI_Actuator;
using swarmanoid::CCI_Column;
using swarmanoid::CCI_Reading;
using swarmanoid::CCI_Sensor;
