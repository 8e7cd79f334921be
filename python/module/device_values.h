// What a device reads or is told, as a row of numbers: the same columns for every robot, so that those of many robots
// are one array. Devices whose readings differ in number (cameras, range and bearing) have rows instead.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/control_interface/ci_robot.h"

namespace swarmanoid::python
{

struct SensorColumns
{
  std::vector<std::string> names;  // "left [m/s]"
  std::function<void(double* to)> read;
};

struct ActuatorColumns
{
  std::vector<std::string> names;
  std::function<void(const double* from)> write;
};

// Readings in rows, as many as there are: blobs, packets, beams, sounds.
struct SensorRows
{
  std::vector<std::string> names;
  std::function<void(std::vector<double>& to)> read;  // row by row
};

// The devices of a robot, by type.
std::map<std::string, CCI_Sensor*> SensorsOf(const CCI_Robot& robot);
std::map<std::string, CCI_Actuator*> ActuatorsOf(const CCI_Robot& robot);

// Of the device, which outlives what is returned. Without names if it has rows.
SensorColumns ColumnsOf(CCI_Sensor& sensor);
// Without names if it has columns.
SensorRows RowsOf(CCI_Sensor& sensor);
// Without names for a device that no column can tell what to do.
ActuatorColumns ColumnsOf(CCI_Actuator& actuator);

}  // namespace swarmanoid::python
