// The devices of a robot in the table `robot` of Lua.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/control_interface/ci_sensor.h>

#include <lua.hpp>
#include <string>

namespace swarmanoid::argos3
{

// Adds the functions of a device. `robot` must be on top of the stack. Throws CARGoSException for a device that has no
// place in it.
void AddFunctions(lua_State* lua, const std::string& tag, argos::CCI_Actuator& actuator);
void AddFunctions(lua_State* lua, const std::string& tag, argos::CCI_Sensor& sensor);
// Writes the current readings of the sensor.
void AddReadings(lua_State* lua, const std::string& tag, argos::CCI_Sensor& sensor);

}  // namespace swarmanoid::argos3
