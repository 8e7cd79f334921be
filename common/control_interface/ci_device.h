// CCI_Sensor and CCI_Actuator: a set of devices of one type on one robot, as a controller sees them.
//
// The label of a type, by which the experiment file and controllers name it, is the name of its header without ci_,
// _sensor and _actuator: footbot/ci_footbot_wheels_actuator.h declares the actuator "footbot_wheels".
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/control_interface/ci_columns.h"

namespace swarmanoid
{

// One value of a device in the form for users.
struct CCI_Reading
{
  std::string name;  // "left", "7", "blob 0 distance"
  std::string unit;  // see CCI_Column
  double value = 0;
};

// The base of all devices, for programs that do not know their interface. The columns follow from the declaration of
// the interface, which is CCI_SensorOf or CCI_ActuatorOf of itself.
class CCI_Device
{
public:
  virtual ~CCI_Device() = default;

  // Returns the declaration of the interface, which may be empty.
  virtual const CCI_Columns& Declared() const;

  // Columns returns the columns of the readings that exist at every tick. ReadColumns appends one number for each.
  std::vector<CCI_Column> Columns() const;
  void ReadColumns(std::vector<double>& values) const;
  // Rows returns the columns of readings whose count differs between ticks. ReadRows appends them row after row.
  std::vector<CCI_Column> Rows() const;
  void ReadRows(std::vector<double>& values) const;
  // Appends the id of the entity that each row is about, or nothing if the device does not know it.
  void ReadRowIds(std::vector<std::string>& ids) const;

  // Appends the present readings and the last settings, for users who watch the robot.
  void Describe(std::vector<CCI_Reading>& readings) const;

protected:
  // Appends the last settings of an actuator, a number for each column, or nothing if the implementation does not keep
  // them.
  virtual void ReadSettings(std::vector<double>&) const {}

private:
  void DescribeRows(std::vector<CCI_Reading>& readings) const;
};

// All sensor interfaces derive from this class. Readings in a control step are those of its start, at any time in the
// step.
class CCI_Sensor : public CCI_Device
{
};

// All actuator interfaces derive from this class. Values set in a control step take effect when it ends, and stay until
// set again.
class CCI_Actuator : public CCI_Device
{
public:
  // Returns the columns that SetColumns can set, in SI units. It is empty if the actuator has none.
  std::vector<CCI_Column> Columns() const;
  // Sets all columns at once. `values` must have a finite number for each column. Values outside a range are clamped to
  // it. Switches are on above 0.5.
  void SetColumns(std::span<const double> values)
  {
    CCI_Device* const self = this;
    Declared().set({&self, 1}, values);
  }
};

// The bases of an interface that declares columns by Interface::Declare.
template <class Interface, class Device>
class CCI_Declaring : public Device
{
public:
  using Declaration = CCI_ColumnsOf<Interface>;

  static const CCI_Columns& AllColumns()
  {
    static const Declaration columns = []
    {
      Declaration all;
      Interface::Declare(all);
      return all;
    }();
    return columns;
  }
  const CCI_Columns& Declared() const override { return AllColumns(); }
};
template <class Interface>
using CCI_SensorOf = CCI_Declaring<Interface, CCI_Sensor>;
template <class Interface>
using CCI_ActuatorOf = CCI_Declaring<Interface, CCI_Actuator>;

}  // namespace swarmanoid

using swarmanoid::CCI_Actuator;
using swarmanoid::CCI_ActuatorOf;
using swarmanoid::CCI_Reading;
using swarmanoid::CCI_Sensor;
using swarmanoid::CCI_SensorOf;
