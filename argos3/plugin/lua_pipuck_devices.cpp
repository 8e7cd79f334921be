// The devices of Pi-Pucks in the table `robot`, with ARGoS3's names.
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_differential_drive_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_ground_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_leds_actuator.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_rangefinders_sensor.h>
#include <argos3/plugins/robots/pi-puck/control_interface/ci_pipuck_system_sensor.h>

#include "argos3/plugin/lua_device_parts.h"
#include "argos3/plugin/lua_vectors.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

namespace
{

using Leds = argos::CCI_PiPuckLEDsActuator;

// In m/s.
int Drive(lua_State* lua)
{
  CheckCount(lua, 2);
  Subject<argos::CCI_PiPuckDifferentialDriveActuator>(lua).SetLinearVelocity(luaL_checknumber(lua, 1),
                                                                             luaL_checknumber(lua, 2));
  return 0;
}

int SwitchRingLed(lua_State* lua)
{
  CheckCount(lua, 2);
  const lua_Integer led = luaL_checkinteger(lua, 1);
  if (led < 1 || led > 8) return luaL_error(lua, "there is no LED %I; they are 1 to 8", led);
  luaL_checktype(lua, 2, LUA_TBOOLEAN);
  Subject<Leds>(lua).SetRingLEDIndex(static_cast<UInt32>(led - 1), lua_toboolean(lua, 2) != 0);
  return 0;
}

template <void (Leds::*Switch)(bool)>
int SwitchLeds(lua_State* lua)
{
  CheckCount(lua, 1);
  luaL_checktype(lua, 1, LUA_TBOOLEAN);
  (Subject<Leds>(lua).*Switch)(lua_toboolean(lua, 1) != 0);
  return 0;
}

// Writes the list of sensors. Each has its place and direction, and readings that set(sensor) writes.
template <class Sensor, class SetReadings>
void ReadVisited(lua_State* lua, argos::CCI_Sensor& sensor, const char* name, const SetReadings& set)
{
  Enter(lua, name);
  dynamic_cast<Sensor&>(sensor).Visit(
      [&](const typename Sensor::SInterface& one)
      {
        Enter(lua, static_cast<lua_Integer>(one.Label + 1));
        set(one);
        Enter(lua, "transform");
        SetVector(lua, "position", std::get<argos::CVector3>(one.Configuration));
        SetQuaternion(lua, "orientation", std::get<argos::CQuaternion>(one.Configuration));
        lua_pushstring(lua, "origin");
        lua_setfield(lua, -2, "anchor");
        Leave(lua);
        Leave(lua);
      });
  Leave(lua);
}

}  // namespace

bool AddPiPuckFunctions(lua_State* lua, const std::string& tag, argos::CCI_Actuator& actuator)
{
  if (tag == "pipuck_differential_drive")
  {
    Enter(lua, "differential_drive");
    SetFunction<Drive>(lua, "set_linear_velocity",
                       &dynamic_cast<argos::CCI_PiPuckDifferentialDriveActuator&>(actuator));
  }
  else if (tag == "pipuck_leds")
  {
    auto& leds = dynamic_cast<Leds&>(actuator);
    Enter(lua, "leds");
    SetFunction<SwitchRingLed>(lua, "set_ring_led_index", &leds);
    SetFunction<SwitchLeds<&Leds::SetRingLEDs>>(lua, "set_ring_leds", &leds);
    SetFunction<SwitchLeds<&Leds::SetFrontLED>>(lua, "set_front_led", &leds);
    SetFunction<SwitchLeds<&Leds::SetBodyLED>>(lua, "set_body_led", &leds);
  }
  else
    return false;
  Leave(lua);
  return true;
}

bool ReadPiPuckSensor(lua_State* lua, const std::string& tag, argos::CCI_Sensor& sensor)
{
  if (tag == "pipuck_rangefinders")
    ReadVisited<argos::CCI_PiPuckRangefindersSensor>(lua, sensor, "rangefinders",
                                                     [lua](const auto& one)
                                                     {
                                                       Set(lua, "proximity", one.Proximity);
                                                       Set(lua, "illuminance", one.Illuminance);
                                                     });
  else if (tag == "pipuck_ground")
    ReadVisited<argos::CCI_PiPuckGroundSensor>(lua, sensor, "ground_sensors",
                                               [lua](const auto& one)
                                               {
                                                 Set(lua, "reflected", one.Reflected);
                                                 Set(lua, "background", one.Background);
                                               });
  else if (tag == "pipuck_differential_drive")
  {
    auto& speeds = dynamic_cast<argos::CCI_PiPuckDifferentialDriveSensor&>(sensor);
    Enter(lua, "differential_drive");
    Enter(lua, "encoders");
    Set(lua, "left", speeds.GetLeftVelocity());
    Set(lua, "right", speeds.GetRightVelocity());
    Leave(lua);
    Leave(lua);
  }
  else if (tag == "pipuck_system")
  {
    const auto& system = dynamic_cast<argos::CCI_PiPuckSystemSensor&>(sensor);
    Enter(lua, "system");
    Set(lua, "time", system.GetTime());
    Set(lua, "temperature", system.GetTemperature());
    Leave(lua);
  }
  else
    return false;
  return true;
}

}  // namespace swarmanoid::argos3
