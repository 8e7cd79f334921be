// The parameters that a script declares, by its call of the function `parameters`:
//
//   local p = parameters{speed = {default = 0.1, unit = "m/s", minimum = 0, maximum = 0.3}, turns = true}
#pragma once

#include <lua.hpp>
#include <string>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid::lua
{

struct LuaScript;

// Reads the table at the place 1 of the stack. Throws std::runtime_error for a declaration that is wrong.
std::vector<ParameterSpec> ReadDeclaration(lua_State* lua);

// Pushes a table with the values of the parameters, in the types of Lua. `tree` has a value for each.
void PushValues(lua_State* lua, const std::vector<ParameterSpec>& specs, const TConfigurationTree& tree);

// Runs the script up to its declaration. Returns nothing if it declares none. Throws std::runtime_error with file and
// line of a mistake.
std::vector<ParameterSpec> DeclaredParameters(LuaScript script);

}  // namespace swarmanoid::lua
