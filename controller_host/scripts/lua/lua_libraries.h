// The libraries of an interpreter of Lua, for the scripts of robots. A script gives the same run in every process, and
// a stranger's script cannot harm the user's machine. Each robot has an interpreter of its own.
#pragma once

#include <functional>
#include <lua.hpp>
#include <string>

namespace swarmanoid::lua
{

struct LuaScript
{
  std::string file;  // the name in messages
  std::string path;
  // Returns the simulated time in s.
  std::function<double()> clock;
};

// Opens Lua's libraries. The global function `log` must exist. The script outlives the interpreter. `seed`: of
// math.random.
void OpenLibraries(lua_State* lua, LuaScript& script, lua_Integer seed);

// Pushes the script as a function. Throws std::runtime_error with file and line if it is no Lua.
void LoadScript(lua_State* lua, const LuaScript& script);

// Calls a function with an empty stack, and catches all errors of Lua, including lack of memory. Throws
// std::runtime_error with the text of the error, which has file and line. No object with a destructor may exist in
// `act` at a call that may raise an error.
void CallProtected(lua_State* lua, const LuaScript& script, const std::function<void()>& act);

// Calls a global function of the script, if it exists.
void CallIfThere(lua_State* lua, const char* name);

}  // namespace swarmanoid::lua
