// Values of Lua as bytes: the table `state` of a script, which checkpoints hold, and what a script keeps elsewhere.
#pragma once

#include <lua.hpp>
#include <map>
#include <set>
#include <string>

#include "common/serialisation/bytes.h"

namespace swarmanoid::lua
{

// Writes the table at a place of the stack: numbers, texts, booleans, and tables of them, in the order of their keys.
// Throws std::runtime_error, which names the value by `name`, for other values, for a table with a metatable, and for a
// table that is there twice.
std::string SavedTable(lua_State* lua, int table, const std::string& name);

// Restores a table that SavedTable wrote. Tables that exist stay the same objects, so that local variables go on to
// refer to them. Throws std::runtime_error if the bytes are damaged.
void LoadTable(lua_State* lua, int table, const std::string& saved);

// Returns the values of all global variables, and of all local variables that functions use, by a name for users.
// Functions and `known` tables and names are left out.
struct KnownValues
{
  std::set<std::string> globals;
  std::set<const void*> tables;
};
std::map<std::string, std::string> ValuesOfScript(lua_State* lua, const KnownValues& known);

}  // namespace swarmanoid::lua
