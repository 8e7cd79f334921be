#include "controller_host/scripts/lua/lua_parameters.h"

#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "controller_host/scripts/declaration/script_declaration.h"
#include "controller_host/scripts/lua/lua_libraries.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::lua
{
namespace
{

// Returns the number, text or boolean on top of the stack.
DeclaredValue ValueOnTop(lua_State* lua, const std::string& parameter)
{
  if (lua_isboolean(lua, -1)) return {ParameterType::kBoolean, lua_toboolean(lua, -1) != 0 ? "true" : "false"};
  if (lua_type(lua, -1) == LUA_TSTRING) return {ParameterType::kText, lua_tostring(lua, -1)};
  if (lua_type(lua, -1) != LUA_TNUMBER)
    throw std::runtime_error("the parameter " + Quoted(parameter) + " has a " + luaL_typename(lua, -1) +
                             ", where a number, text or boolean must be");
  if (lua_isinteger(lua, -1) != 0) return {ParameterType::kNumber, std::to_string(lua_tointeger(lua, -1))};
  // The shortest text of the same number.
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), lua_tonumber(lua, -1)).ptr;
  return {ParameterType::kNumber, {text.data(), end}};
}

// Reads the value on top of the stack: one, or a list.
std::vector<DeclaredValue> ValuesOnTop(lua_State* lua, const std::string& parameter)
{
  if (!lua_istable(lua, -1)) return {ValueOnTop(lua, parameter)};
  std::vector<DeclaredValue> values;
  const auto count = static_cast<lua_Integer>(lua_rawlen(lua, -1));
  for (lua_Integer i = 1; i <= count; ++i)
  {
    lua_rawgeti(lua, -1, i);
    values.push_back(ValueOnTop(lua, parameter));
    lua_pop(lua, 1);
  }
  return values;
}

// Reads the declaration on top of the stack.
ParameterSpec ReadSpec(lua_State* lua, const std::string& parameter)
{
  if (!lua_istable(lua, -1)) return SpecFrom(parameter, {{"default", {ValueOnTop(lua, parameter)}}});
  std::vector<DeclaredField> fields;
  for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1))
  {
    if (lua_type(lua, -2) != LUA_TSTRING)
      throw std::runtime_error("the parameter " + Quoted(parameter) + " has a field without a name");
    fields.push_back({lua_tostring(lua, -2), ValuesOnTop(lua, parameter)});
  }
  return SpecFrom(parameter, fields);
}

void PushValue(lua_State* lua, const ParameterSpec& spec, const TConfigurationTree& tree)
{
  if (!tree.Value(spec.name)) return lua_pushnil(lua);  // its default is ""
  switch (spec.type)
  {
    case ParameterType::kNumber:
      return lua_pushnumber(lua, tree.GetNumber(spec.name));
    case ParameterType::kInteger:
      return lua_pushinteger(lua, tree.GetInteger(spec.name));
    case ParameterType::kColour:
      return lua_pushinteger(lua, tree.GetColour(spec.name));
    case ParameterType::kBoolean:
      return lua_pushboolean(lua, tree.GetBoolean(spec.name) ? 1 : 0);
    default:
      lua_pushstring(lua, tree.GetText(spec.name).c_str());
  }
}

// Takes the declaration and ends the script.
int TakeDeclaration(lua_State* lua)
{
  auto& specs = Subject<std::vector<ParameterSpec>>(lua);
  specs = ReadDeclaration(lua);
  lua_pushlightuserdata(lua, &specs);
  return lua_error(lua);
}

int Nothing(lua_State*) { return 0; }

}  // namespace

std::vector<ParameterSpec> ReadDeclaration(lua_State* lua)
{
  if (lua_gettop(lua) != 1 || !lua_istable(lua, 1))
    throw std::runtime_error("parameters{…} takes a table with a declaration for each name");
  std::vector<ParameterSpec> specs;
  for (lua_pushnil(lua); lua_next(lua, 1) != 0; lua_pop(lua, 1))
  {
    if (lua_type(lua, -2) != LUA_TSTRING) throw std::runtime_error("parameters{…} has a declaration without a name");
    specs.push_back(ReadSpec(lua, lua_tostring(lua, -2)));
  }
  CompleteDeclaration(specs);
  return specs;
}

void PushValues(lua_State* lua, const std::vector<ParameterSpec>& specs, const TConfigurationTree& tree)
{
  lua_createtable(lua, 0, static_cast<int>(specs.size()));
  for (const ParameterSpec& spec : specs)
  {
    PushValue(lua, spec, tree);
    lua_setfield(lua, -2, spec.name.c_str());
  }
}

std::vector<ParameterSpec> DeclaredParameters(LuaScript script)
{
  std::vector<ParameterSpec> specs;
  const std::unique_ptr<lua_State, decltype(&lua_close)> state(luaL_newstate(), lua_close);
  if (state == nullptr) throw std::runtime_error("no memory is left for Lua");
  lua_State* const lua = state.get();
  // The devices do not exist here. A script that declares nothing may use them at once.
  std::ifstream file(script.path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const bool declares = text.find("parameters") != std::string::npos;
  CallProtected(lua, script,
                [&]
                {
                  lua_register(lua, "log", Nothing);
                  OpenLibraries(lua, script, 0);
                  lua_pushglobaltable(lua);
                  SetFunction<TakeDeclaration>(lua, "parameters", &specs);
                  Leave(lua);
                  LoadScript(lua, script);
                  const int result = lua_pcall(lua, 0, 0, 0);
                  const bool is_declared = lua_islightuserdata(lua, -1) && lua_touserdata(lua, -1) == &specs;
                  if (result != LUA_OK && !is_declared && declares) lua_error(lua);
                });
  return specs;
}

}  // namespace swarmanoid::lua
