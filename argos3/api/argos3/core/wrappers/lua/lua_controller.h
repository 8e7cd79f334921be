// CLuaController: a robot's script, whose variables loop functions can read and write. The simulator uses Lua 5.4.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>

#if __has_include(<lua5.4/lua.hpp>)
#include <lua5.4/lua.hpp>
#else
#include <lua.hpp>
#endif
static_assert(LUA_VERSION_NUM == 504, "scripts run by Lua 5.4; install liblua5.4-dev");

namespace argos
{

class CLuaController : public CCI_Controller
{
public:
  ~CLuaController() override;
  // Returns nullptr before Init of the controller. The caller must leave the stack as it was.
  lua_State* GetLuaState() { return m_ptLuaState; }
  bool IsOK() const { return true; }

protected:
  lua_State* m_ptLuaState = nullptr;
};

}  // namespace argos
