// Tables and functions of Lua, as devices need them. All work at the table on top of the stack.
#pragma once

#include <exception>
#include <lua.hpp>

namespace swarmanoid::argos3
{

// Puts the table of that name on top, made if there is none.
inline void Enter(lua_State* lua, const char* name)
{
  if (lua_getfield(lua, -1, name) == LUA_TTABLE) return;
  lua_pop(lua, 1);
  lua_newtable(lua);
  lua_pushvalue(lua, -1);
  lua_setfield(lua, -3, name);
}

inline void Enter(lua_State* lua, lua_Integer number)
{
  if (lua_rawgeti(lua, -1, number) == LUA_TTABLE) return;
  lua_pop(lua, 1);
  lua_newtable(lua);
  lua_pushvalue(lua, -1);
  lua_rawseti(lua, -3, number);
}

// Tables that nobody has seen, with room for what they will have.
inline void EnterNew(lua_State* lua, lua_Integer number, int fields)
{
  lua_createtable(lua, 0, fields);
  lua_pushvalue(lua, -1);
  lua_rawseti(lua, -3, number);
}

inline void EnterNew(lua_State* lua, const char* name, int elements, int fields)
{
  lua_createtable(lua, elements, fields);
  lua_pushvalue(lua, -1);
  lua_setfield(lua, -3, name);
}

inline void Leave(lua_State* lua) { lua_pop(lua, 1); }

inline void Set(lua_State* lua, const char* name, double value)
{
  lua_pushnumber(lua, value);
  lua_setfield(lua, -2, name);
}

// Without what is behind the first `count` elements.
inline void Shorten(lua_State* lua, lua_Integer count)
{
  for (auto last = static_cast<lua_Integer>(lua_rawlen(lua, -1)); last > count; --last)
  {
    lua_pushnil(lua);
    lua_rawseti(lua, -2, last);
  }
}

// No exception passes through Lua, which is C. Nothing with a destructor may live where Function calls luaL_check….
template <auto Function>
int Guarded(lua_State* lua)
{
  try
  {
    return Function(lua);
  }
  catch (const std::exception& error)
  {
    luaL_where(lua, 1);  // nothing if C called
    lua_pushstring(lua, error.what());
    lua_concat(lua, 2);
  }
  return lua_error(lua);
}

// A function whose Subject is `subject`.
template <auto Function>
void SetFunction(lua_State* lua, const char* name, void* subject)
{
  lua_pushlightuserdata(lua, subject);
  lua_pushcclosure(lua, Guarded<Function>, 1);
  lua_setfield(lua, -2, name);
}

template <class Type>
Type& Subject(lua_State* lua)
{
  return *static_cast<Type*>(lua_touserdata(lua, lua_upvalueindex(1)));
}

inline void CheckCount(lua_State* lua, int count)
{
  if (lua_gettop(lua) != count) luaL_error(lua, "%d values are given, and %d are needed", lua_gettop(lua), count);
}

}  // namespace swarmanoid::argos3
