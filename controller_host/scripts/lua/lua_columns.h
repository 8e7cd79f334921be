// The devices of a robot in the table `robot` of Lua, by the columns that their interfaces declare:
// robot.compass.heading, robot.footbot_proximity[1]. Names and units are those of the columns, with '_' for blanks.
// Columns that are called by numbers alone, from 0, are a list from 1.
#pragma once

#include <lua.hpp>
#include <string>
#include <vector>

#include "common/control_interface/ci_device.h"

namespace swarmanoid::lua
{

// The name of a column in Lua.
struct ColumnName
{
  std::string name;
  lua_Integer number = 0;  // from 1, if it is called by a number
};

class SensorTable
{
public:
  // The sensor outlives the table.
  explicit SensorTable(const CCI_Sensor& sensor);

  // Writes the current readings into the table on top of the stack. Rows are the list `rows`.
  void Read(lua_State* lua);

private:
  void ReadRows(lua_State* lua);

  const CCI_Sensor* sensor_;
  std::vector<ColumnName> columns_, rows_;
  std::vector<double> values_;  // scratch
  std::vector<std::string> ids_;
};

// Adds the function `set` to the table on top of the stack. It takes a number for each column, or a list of them. The
// actuator outlives the table.
void AddSetter(lua_State* lua, CCI_Actuator& actuator);

}  // namespace swarmanoid::lua
