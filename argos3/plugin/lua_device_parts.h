// The devices of single robots in the table `robot` of Lua. Only lua_devices.cpp includes it.
#pragma once

#include <argos3/core/utility/datatypes/color.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_position_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_speed_actuator.h>

#include <lua.hpp>
#include <string>

namespace swarmanoid::argos3
{

// Adds the functions of a device. `robot` must be on top of the stack.
void AddTurret(lua_State* lua, argos::CCI_FootBotTurretActuator& turret);
void AddScanner(lua_State* lua, argos::CCI_FootBotDistanceScannerActuator& scanner);
void AddGripper(lua_State* lua, argos::CCI_FootBotGripperActuator& gripper);
void AddPosition(lua_State* lua, argos::CCI_QuadRotorPositionActuator& quadrotor);
void AddSpeed(lua_State* lua, argos::CCI_QuadRotorSpeedActuator& quadrotor);
// Adds the functions of an actuator of argos3-epuck. Returns false for other tags.
bool AddEPuckFunctions(lua_State* lua, const std::string& tag, argos::CCI_Actuator& actuator);
// Add the functions of an actuator of Pi-Pucks, and write the readings of a sensor. They return false for other tags.
bool AddPiPuckFunctions(lua_State* lua, const std::string& tag, argos::CCI_Actuator& actuator);
bool ReadPiPuckSensor(lua_State* lua, const std::string& tag, argos::CCI_Sensor& sensor);
// Return the colour at the end of the arguments, a name or three numbers, and a number as a byte. A number that is too
// large for a byte loses its higher bits, as in ARGoS3.
argos::CColor ColourAt(lua_State* lua, int index);
UInt8 ByteAt(lua_State* lua, int index);
// Write the current readings.
void ReadEPuckGround(lua_State* lua, argos::CCI_EPuckGroundSensor& sensor);
void ReadEPuckPackets(lua_State* lua, argos::CCI_EPuckRangeAndBearingSensor& sensor);
void ReadScanner(lua_State* lua, argos::CCI_FootBotDistanceScannerSensor& scanner);

}  // namespace swarmanoid::argos3
