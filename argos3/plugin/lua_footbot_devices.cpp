#include <cmath>

#include "argos3/plugin/lua_device_parts.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

namespace
{

// Calls a function without arguments.
template <class Actuator, void (Actuator::*Act)()>
int Call(lua_State* lua)
{
  CheckCount(lua, 0);
  (Subject<Actuator>(lua).*Act)();
  return 0;
}

// The next functions are those of robot.turret, in rad and rad/s.

int SetRotation(lua_State* lua)
{
  CheckCount(lua, 1);
  Subject<argos::CCI_FootBotTurretActuator>(lua).SetRotation(argos::CRadians(luaL_checknumber(lua, 1)));
  return 0;
}

int SetRotationSpeed(lua_State* lua)
{
  CheckCount(lua, 1);
  const double speed = luaL_checknumber(lua, 1);
  if (!(std::abs(speed) <= 1e6)) return luaL_argerror(lua, 1, "that is no speed of a turret");
  Subject<argos::CCI_FootBotTurretActuator>(lua).SetRotationSpeed(static_cast<SInt32>(speed));
  return 0;
}

template <argos::CCI_FootBotTurretActuator::ETurretModes mode>
int SetTurretMode(lua_State* lua)
{
  Subject<argos::CCI_FootBotTurretActuator>(lua).SetMode(mode);
  return 0;
}

// The next functions are those of robot.distance_scanner, in rad and turns a minute; readings are in cm and rad.

int SetScannerAngle(lua_State* lua)
{
  CheckCount(lua, 1);
  Subject<argos::CCI_FootBotDistanceScannerActuator>(lua).SetAngle(argos::CRadians(luaL_checknumber(lua, 1)));
  return 0;
}

int SetRpm(lua_State* lua)
{
  CheckCount(lua, 1);
  Subject<argos::CCI_FootBotDistanceScannerActuator>(lua).SetRPM(luaL_checknumber(lua, 1));
  return 0;
}

void ReadBeams(lua_State* lua, const argos::CCI_FootBotDistanceScannerSensor::TReadingsMap& readings, const char* name)
{
  Enter(lua, name);
  lua_Integer count = 0;
  for (const auto& [angle, distance] : readings)
  {
    EnterNew(lua, ++count, 2);
    Set(lua, "angle", angle.GetValue());
    Set(lua, "distance", distance);
    Leave(lua);
  }
  Shorten(lua, count);
  Leave(lua);
}

}  // namespace

void AddTurret(lua_State* lua, argos::CCI_FootBotTurretActuator& turret)
{
  using Actuator = argos::CCI_FootBotTurretActuator;
  Enter(lua, "turret");
  SetFunction<SetRotation>(lua, "set_rotation", &turret);
  SetFunction<SetRotationSpeed>(lua, "set_rotation_speed", &turret);
  SetFunction<SetTurretMode<Actuator::MODE_POSITION_CONTROL>>(lua, "set_position_control_mode", &turret);
  SetFunction<SetTurretMode<Actuator::MODE_SPEED_CONTROL>>(lua, "set_speed_control_mode", &turret);
  SetFunction<SetTurretMode<Actuator::MODE_PASSIVE>>(lua, "set_passive_mode", &turret);
  Leave(lua);
}

void AddScanner(lua_State* lua, argos::CCI_FootBotDistanceScannerActuator& scanner)
{
  using Actuator = argos::CCI_FootBotDistanceScannerActuator;
  Enter(lua, "distance_scanner");
  SetFunction<Call<Actuator, &Actuator::Enable>>(lua, "enable", &scanner);
  SetFunction<Call<Actuator, &Actuator::Disable>>(lua, "disable", &scanner);
  SetFunction<SetScannerAngle>(lua, "set_angle", &scanner);
  SetFunction<SetRpm>(lua, "set_rpm", &scanner);
  Leave(lua);
}

void ReadScanner(lua_State* lua, argos::CCI_FootBotDistanceScannerSensor& scanner)
{
  Enter(lua, "distance_scanner");
  ReadBeams(lua, scanner.GetShortReadingsMap(), "short_range");
  ReadBeams(lua, scanner.GetLongReadingsMap(), "long_range");
  Leave(lua);
}

void AddGripper(lua_State* lua, argos::CCI_FootBotGripperActuator& gripper)
{
  using Actuator = argos::CCI_FootBotGripperActuator;
  Enter(lua, "gripper");
  SetFunction<Call<Actuator, &Actuator::LockPositive>>(lua, "lock_positive", &gripper);
  SetFunction<Call<Actuator, &Actuator::LockNegative>>(lua, "lock_negative", &gripper);
  SetFunction<Call<Actuator, &Actuator::Unlock>>(lua, "unlock", &gripper);
  Leave(lua);
}

}  // namespace swarmanoid::argos3
