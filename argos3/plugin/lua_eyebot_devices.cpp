#include <numbers>

#include "argos3/plugin/lua_device_parts.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

namespace
{

// The next functions are those of robot.quadrotor, in m and degrees, and in m/s and rad/s.

template <void (argos::CCI_QuadRotorPositionActuator::*Go)(const argos::CVector3&)>
int FlyTo(lua_State* lua)
{
  CheckCount(lua, 3);
  (Subject<argos::CCI_QuadRotorPositionActuator>(lua).*
   Go)(argos::CVector3(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2), luaL_checknumber(lua, 3)));
  return 0;
}

template <void (argos::CCI_QuadRotorPositionActuator::*Turn)(const argos::CRadians&)>
int TurnTo(lua_State* lua)
{
  CheckCount(lua, 1);
  (Subject<argos::CCI_QuadRotorPositionActuator>(lua).*
   Turn)(argos::CRadians(luaL_checknumber(lua, 1) * std::numbers::pi / 180));
  return 0;
}

int SetLinearVelocity(lua_State* lua)
{
  // Older scripts pass two numbers.
  if (lua_gettop(lua) != 2) CheckCount(lua, 3);
  Subject<argos::CCI_QuadRotorSpeedActuator>(lua).SetLinearVelocity(
      argos::CVector3(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2), luaL_optnumber(lua, 3, 0)));
  return 0;
}

int SetRotationalSpeed(lua_State* lua)
{
  CheckCount(lua, 1);
  Subject<argos::CCI_QuadRotorSpeedActuator>(lua).SetRotationalSpeed(argos::CRadians(luaL_checknumber(lua, 1)));
  return 0;
}

}  // namespace

void AddPosition(lua_State* lua, argos::CCI_QuadRotorPositionActuator& quadrotor)
{
  using Actuator = argos::CCI_QuadRotorPositionActuator;
  Enter(lua, "quadrotor");
  SetFunction<FlyTo<&Actuator::SetAbsolutePosition>>(lua, "set_absolute_position", &quadrotor);
  SetFunction<FlyTo<&Actuator::SetRelativePosition>>(lua, "set_relative_position", &quadrotor);
  SetFunction<TurnTo<&Actuator::SetAbsoluteYaw>>(lua, "set_absolute_yaw", &quadrotor);
  SetFunction<TurnTo<&Actuator::SetRelativeYaw>>(lua, "set_relative_yaw", &quadrotor);
  Leave(lua);
}

void AddSpeed(lua_State* lua, argos::CCI_QuadRotorSpeedActuator& quadrotor)
{
  Enter(lua, "quadrotor");
  SetFunction<SetLinearVelocity>(lua, "set_linear_velocity", &quadrotor);
  SetFunction<SetRotationalSpeed>(lua, "set_rotational_speed", &quadrotor);
  Leave(lua);
}

}  // namespace swarmanoid::argos3
