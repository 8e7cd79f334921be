// The devices of e-pucks of argos3-epuck in the table `robot`, with the plug-in's names.
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_base_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_rgb_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_wheels_actuator.h>

#include "argos3/plugin/lua_device_parts.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

namespace
{

int SetEPuckVelocity(lua_State* lua)
{
  CheckCount(lua, 2);
  Subject<argos::CCI_EPuckWheelsActuator>(lua).SetLinearVelocity(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2));
  return 0;
}

int SetEPuckColor(lua_State* lua)
{
  const lua_Integer led = luaL_checkinteger(lua, 1);
  if (led < 1 || led > 3) return luaL_error(lua, "there is no LED %I; they are 1 to 3", led);
  Subject<argos::CCI_EPuckRGBLEDsActuator>(lua).SetColor(static_cast<size_t>(led - 1), ColourAt(lua, 2));
  return 0;
}

int SetEPuckColors(lua_State* lua)
{
  Subject<argos::CCI_EPuckRGBLEDsActuator>(lua).SetColors(ColourAt(lua, 1));
  return 0;
}

int SwitchEPuckLed(lua_State* lua)
{
  CheckCount(lua, 2);
  const lua_Integer led = luaL_checkinteger(lua, 1);
  if (led < 1 || led > 8) return luaL_error(lua, "there is no LED %I; they are 1 to 8", led);
  luaL_checktype(lua, 2, LUA_TBOOLEAN);
  Subject<argos::CCI_EPuckBaseLEDsActuator>(lua).SwitchLED(static_cast<size_t>(led - 1), lua_toboolean(lua, 2) != 0);
  return 0;
}

int SwitchEPuckLeds(lua_State* lua)
{
  CheckCount(lua, 1);
  luaL_checktype(lua, 1, LUA_TBOOLEAN);
  Subject<argos::CCI_EPuckBaseLEDsActuator>(lua).SwitchLEDs(lua_toboolean(lua, 1) != 0);
  return 0;
}

int SetEPuckData(lua_State* lua)
{
  constexpr auto kBytes = static_cast<lua_Integer>(argos::CCI_EPuckRangeAndBearingActuator::MAX_BYTES_SENT);
  CheckCount(lua, 1);
  luaL_checktype(lua, 1, LUA_TTABLE);
  const auto count = static_cast<lua_Integer>(lua_rawlen(lua, 1));
  if (count != kBytes) return luaL_error(lua, "%I bytes are given, and a message has %I", count, kBytes);
  argos::CCI_EPuckRangeAndBearingActuator::TData data;
  for (lua_Integer i = 1; i <= kBytes; ++i)
  {
    lua_rawgeti(lua, 1, i);
    data[i - 1] = ByteAt(lua, -1);
    lua_pop(lua, 1);
  }
  Subject<argos::CCI_EPuckRangeAndBearingActuator>(lua).SetData(data);
  return 0;
}

}  // namespace

bool AddEPuckFunctions(lua_State* lua, const std::string& tag, argos::CCI_Actuator& actuator)
{
  if (tag == "epuck_wheels")
  {
    Enter(lua, "wheels");
    SetFunction<SetEPuckVelocity>(lua, "set_velocity", &dynamic_cast<argos::CCI_EPuckWheelsActuator&>(actuator));
  }
  else if (tag == "epuck_rgb_leds")
  {
    auto& leds = dynamic_cast<argos::CCI_EPuckRGBLEDsActuator&>(actuator);
    Enter(lua, "overo_leds");
    SetFunction<SetEPuckColor>(lua, "set_single_color", &leds);
    SetFunction<SetEPuckColors>(lua, "set_all_colors", &leds);
  }
  else if (tag == "epuck_base_leds")
  {
    auto& leds = dynamic_cast<argos::CCI_EPuckBaseLEDsActuator&>(actuator);
    Enter(lua, "base_leds");
    SetFunction<SwitchEPuckLed>(lua, "switch_led", &leds);
    SetFunction<SwitchEPuckLeds>(lua, "switch_leds", &leds);
  }
  else if (tag == "epuck_range_and_bearing")
  {
    Enter(lua, "range_and_bearing");
    SetFunction<SetEPuckData>(lua, "set_data", &dynamic_cast<argos::CCI_EPuckRangeAndBearingActuator&>(actuator));
  }
  else
    return false;
  Leave(lua);
  return true;
}

void ReadEPuckGround(lua_State* lua, argos::CCI_EPuckGroundSensor& sensor)
{
  Enter(lua, "ground");
  Set(lua, "left", sensor.GetReadings().Left);
  Set(lua, "center", sensor.GetReadings().Center);
  Set(lua, "right", sensor.GetReadings().Right);
  Leave(lua);
}

void ReadEPuckPackets(lua_State* lua, argos::CCI_EPuckRangeAndBearingSensor& sensor)
{
  Enter(lua, "range_and_bearing");
  lua_Integer count = 0;
  for (const auto* packet : sensor.GetPackets())
  {
    EnterNew(lua, ++count, 3);
    Set(lua, "range", packet->Range);
    Set(lua, "bearing", packet->Bearing.GetValue());
    constexpr int kBytes = argos::CCI_EPuckRangeAndBearingSensor::MAX_BYTES_RECEIVED;
    EnterNew(lua, "data", kBytes, 0);
    for (int i = 0; i < kBytes; ++i)
    {
      lua_pushinteger(lua, packet->Data[i]);
      lua_rawseti(lua, -2, i + 1);
    }
    Leave(lua);
    Leave(lua);
  }
  Shorten(lua, count);
  Leave(lua);
}

}  // namespace swarmanoid::argos3
