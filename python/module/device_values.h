// The readings or settings of a device as numbers, in the columns that its interface declares (ci_columns.h).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/control_interface/ci_robot.h"

namespace swarmanoid::python
{

// Returns the devices of a robot, by type.
std::map<std::string, CCI_Sensor*> SensorsOf(const CCI_Robot& robot);
std::map<std::string, CCI_Actuator*> ActuatorsOf(const CCI_Robot& robot);

// Returns the names of columns with their units: "left [rad/s]", "colour".
std::vector<std::string> NamesOf(const std::vector<CCI_Column>& columns);

// A sensor of a robot, which outlives it.
class SensorReader
{
public:
  SensorReader() = default;
  SensorReader(std::string type, const CCI_Sensor& sensor);

  // Returns the names of its columns; empty: it has none.
  const std::vector<std::string>& Columns() const { return columns_; }
  const std::vector<std::string>& Rows() const { return rows_; }
  // Replaces `values` by the readings: a number for each column, or row after row. Throws std::runtime_error if the
  // sensor gives another number of values than it states.
  void ReadColumns(std::vector<double>& values) const;
  void ReadRows(std::vector<double>& values) const;
  // Returns the ids of the entities that the rows are about, or nothing if the sensor does not have them.
  std::vector<std::string> RowIds() const;

private:
  std::string type_;
  const CCI_Sensor* sensor_ = nullptr;
  std::vector<std::string> columns_, rows_;
};

}  // namespace swarmanoid::python
