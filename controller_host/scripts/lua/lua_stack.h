// Tables and functions of Lua, for devices. All functions work on the table on top of the stack.
#pragma once

#include <exception>
#include <lua.hpp>

namespace swarmanoid::lua
{

// Pushes the table of that name, which is made if it does not exist.
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

// Pushes a global variable without the metamethods that a script may give to the table of globals, and returns its
// type.
inline int PushGlobal(lua_State* lua, const char* name)
{
  lua_pushglobaltable(lua);
  lua_pushstring(lua, name);
  const int type = lua_rawget(lua, -2);
  lua_remove(lua, -2);
  return type;
}

// Makes new tables with space for their elements.
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

// Removes the elements behind the first `count`.
inline void Shorten(lua_State* lua, lua_Integer count)
{
  for (auto last = static_cast<lua_Integer>(lua_rawlen(lua, -1)); last > count; --last)
  {
    lua_pushnil(lua);
    lua_rawseti(lua, -2, last);
  }
}

// No exception may pass through Lua, which is written in C. In Function, no object with a destructor may exist at a
// call of luaL_check….
template <auto Function>
int Guarded(lua_State* lua)
{
  try
  {
    return Function(lua);
  }
  catch (const std::exception& error)
  {
    luaL_where(lua, 1);  // empty if C called
    lua_pushstring(lua, error.what());
    lua_concat(lua, 2);
  }
  return lua_error(lua);
}

// Adds a function with `subject` as its Subject.
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

}  // namespace swarmanoid::lua
