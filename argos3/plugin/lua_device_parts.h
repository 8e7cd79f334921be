// The devices of single robots in the table `robot` of Lua. Only lua_devices.cpp includes it.
#pragma once

#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_distance_scanner_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_position_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_quadrotor_speed_actuator.h>

#include <lua.hpp>

namespace swarmanoid::argos3
{

// Adds the functions of a device. `robot` must be on top of the stack.
void AddTurret(lua_State* lua, argos::CCI_FootBotTurretActuator& turret);
void AddScanner(lua_State* lua, argos::CCI_FootBotDistanceScannerActuator& scanner);
void AddGripper(lua_State* lua, argos::CCI_FootBotGripperActuator& gripper);
void AddPosition(lua_State* lua, argos::CCI_QuadRotorPositionActuator& quadrotor);
void AddSpeed(lua_State* lua, argos::CCI_QuadRotorSpeedActuator& quadrotor);
// Writes the current readings.
void ReadScanner(lua_State* lua, argos::CCI_FootBotDistanceScannerSensor& scanner);

}  // namespace swarmanoid::argos3
