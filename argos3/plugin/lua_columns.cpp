// The devices that ARGoS3 does not have, in the table `robot` of Lua: robot.compass.heading, robot.radio[1].length.
// Names and units are those of the columns, with '_' for blanks.
#include <algorithm>
#include <vector>

#include "argos3/plugin/lua_devices.h"
#include "argos3/plugin/lua_stack.h"

namespace swarmanoid::argos3
{
namespace
{

// Sets one number in the table on top of the stack. Columns that are called by numbers alone, from 0, are a list
// from 1.
void SetColumn(lua_State* lua, const CCI_Column& column, double value)
{
  std::string name = column.name;
  std::ranges::replace(name, ' ', '_');
  lua_pushnumber(lua, value);
  if (name.find_first_not_of("0123456789") == std::string::npos)
    lua_rawseti(lua, -2, std::stoll(name) + 1);
  else
    lua_setfield(lua, -2, name.c_str());
}

// Sets a number for each column: set(…).
int SetColumns(lua_State* lua)
{
  auto& actuator = Subject<CCI_Actuator>(lua);
  const int count = static_cast<int>(actuator.Columns().size());
  CheckCount(lua, count);
  for (int i = 1; i <= count; ++i) luaL_checknumber(lua, i);
  std::vector<double> values;
  for (int i = 1; i <= count; ++i) values.push_back(lua_tonumber(lua, i));
  actuator.SetColumns(values);
  return 0;
}

// Writes the list `rows`, one table for each.
void ReadRows(lua_State* lua, const CCI_Sensor& sensor, const std::vector<CCI_Column>& row)
{
  std::vector<double> values;
  sensor.ReadRows(values);
  std::vector<std::string> ids;
  sensor.ReadRowIds(ids);
  Enter(lua, "rows");
  const std::size_t count = values.size() / row.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    EnterNew(lua, static_cast<lua_Integer>(k + 1), static_cast<int>(row.size()) + 1);
    for (std::size_t i = 0; i < row.size(); ++i) SetColumn(lua, row[i], values[k * row.size() + i]);
    if (k < ids.size())
    {
      lua_pushstring(lua, ids[k].c_str());
      lua_setfield(lua, -2, "id");
    }
    Leave(lua);
  }
  Shorten(lua, static_cast<lua_Integer>(count));
  Leave(lua);
}

}  // namespace

void AddColumns(lua_State* lua, const std::string& type, CCI_Actuator& actuator)
{
  Enter(lua, type.c_str());
  SetFunction<SetColumns>(lua, "set", &actuator);
  Leave(lua);
}

void ReadColumns(lua_State* lua, const std::string& type, const CCI_Sensor& sensor)
{
  Enter(lua, type.c_str());
  std::vector<double> values;
  sensor.ReadColumns(values);
  const std::vector<CCI_Column> columns = sensor.Columns();
  for (std::size_t i = 0; i < std::min(columns.size(), values.size()); ++i) SetColumn(lua, columns[i], values[i]);
  if (const std::vector<CCI_Column> row = sensor.Rows(); !row.empty()) ReadRows(lua, sensor, row);
  Leave(lua);
}

}  // namespace swarmanoid::argos3
