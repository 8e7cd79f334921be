#include "controller_host/scripts/lua/lua_columns.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::lua
{
namespace
{

std::vector<ColumnName> NamesOf(const std::vector<CCI_Column>& columns)
{
  std::vector<ColumnName> names;
  for (const CCI_Column& column : columns)
  {
    ColumnName& name = names.emplace_back(ColumnName{column.name});
    std::ranges::replace(name.name, ' ', '_');
    if (name.name.find_first_not_of("0123456789") == std::string::npos) name.number = std::stoll(name.name) + 1;
  }
  return names;
}

void SetColumn(lua_State* lua, const ColumnName& column, double value)
{
  lua_pushnumber(lua, value);
  if (column.number != 0)
    lua_rawseti(lua, -2, column.number);
  else
    lua_setfield(lua, -2, column.name.c_str());
}

int SetColumns(lua_State* lua)
{
  auto& actuator = Subject<CCI_Actuator>(lua);
  const auto count = static_cast<lua_Integer>(actuator.Columns().size());
  const bool is_list = lua_gettop(lua) == 1 && lua_istable(lua, 1);
  const lua_Integer given = is_list ? luaL_len(lua, 1) : lua_gettop(lua);
  if (given != count)
    return luaL_error(lua, "%d values are given, and %d are needed", static_cast<int>(given), static_cast<int>(count));
  luaL_checkstack(lua, static_cast<int>(count), "too many columns");
  if (is_list)
    for (lua_Integer i = 1; i <= count; ++i) lua_geti(lua, 1, i);
  const int first = is_list ? 2 : 1;
  for (int i = 0; i < count; ++i)
  {
    int is_number = 0;
    const double value = lua_tonumberx(lua, first + i, &is_number);
    if (is_number == 0)
      return luaL_error(lua, "value %d is a %s; it must be a number", i + 1, luaL_typename(lua, first + i));
    if (!std::isfinite(value)) return luaL_error(lua, "value %d is not finite", i + 1);
  }
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(lua_tonumber(lua, first + i));
  actuator.SetColumns(values);
  return 0;
}

}  // namespace

SensorTable::SensorTable(const CCI_Sensor& sensor)
    : sensor_(&sensor), columns_(NamesOf(sensor.Columns())), rows_(NamesOf(sensor.Rows()))
{
}

void SensorTable::Read(lua_State* lua)
{
  values_.clear();
  sensor_->ReadColumns(values_);
  for (std::size_t i = 0; i < std::min(columns_.size(), values_.size()); ++i) SetColumn(lua, columns_[i], values_[i]);
  if (!rows_.empty()) ReadRows(lua);
}

void SensorTable::ReadRows(lua_State* lua)
{
  values_.clear();
  sensor_->ReadRows(values_);
  ids_.clear();
  sensor_->ReadRowIds(ids_);
  Enter(lua, "rows");
  const std::size_t width = rows_.size(), count = values_.size() / width;
  for (std::size_t k = 0; k < count; ++k)
  {
    EnterNew(lua, static_cast<lua_Integer>(k + 1), static_cast<int>(width) + 1);
    for (std::size_t i = 0; i < width; ++i) SetColumn(lua, rows_[i], values_[k * width + i]);
    if (k < ids_.size())
    {
      lua_pushstring(lua, ids_[k].c_str());
      lua_setfield(lua, -2, "id");
    }
    Leave(lua);
  }
  Shorten(lua, static_cast<lua_Integer>(count));
  Leave(lua);
}

void AddSetter(lua_State* lua, CCI_Actuator& actuator) { SetFunction<SetColumns>(lua, "set", &actuator); }

}  // namespace swarmanoid::lua
