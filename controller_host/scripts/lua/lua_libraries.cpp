// Scripts must give the same run in every process, although Lua orders tables by addresses, so a prelude replaces what
// depends on addresses or on the time of day. Scripts of strangers may not harm the user's machine, so a second text
// takes away the functions that could.
//
// Errors of Lua are raised by longjmp, which must not cross C++ objects with destructors: every function that Lua calls
// goes through Guarded, which turns exceptions into errors of Lua, and each entry from C++ is a protected call.
#include "controller_host/scripts/lua/lua_libraries.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "common/configuration/trust.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::lua
{
namespace
{

// Runs before the script, with the clock and a seed. Lua seeds its tables and random numbers from addresses and the
// time of day. Here the same script does the same in every process:
//   - pairs() and next() visit numbers, then texts, in ascending order;
//   - table.sort is stable for long lists, where Lua's own sort may choose by the time of day;
//   - math.random is seeded by the robot, and time is that of the simulation.
// Functions of older versions of Lua are added.
constexpr const char* kPrelude = R"(
local clock, seed, length_of = ...
local raw_next, raw_pairs, rawget, type, error, getmetatable = next, pairs, rawget, type, error, getmetatable
local sort, randomseed, date, floor = table.sort, math.randomseed, os.date, math.floor

local rank = {boolean = 1, number = 2, string = 3}
local function comes_before(a, b)
  local x, y = rank[type(a)], rank[type(b)]
  if x ~= y then return x < y end
  if x == 1 then return b and not a end
  return a < b
end

local function keys_of(t)
  local keys, count, last, sorted = {}, 0, nil, true
  for key in raw_next, t do
    local kind = type(key)
    if not rank[kind] then
      error("a table whose keys are of type " .. kind .. " has no order that is the same in every run; use numbers or texts", 3)
    end
    if last ~= nil and sorted and not comes_before(last, key) then sorted = false end
    count, last = count + 1, key
    keys[count] = key
  end
  if not sorted then sort(keys, comes_before) end
  return keys
end

function pairs(t)
  local meta = getmetatable(t)
  if type(t) ~= "table" or type(meta) == "table" and meta.__pairs then return raw_pairs(t) end
  local i, length = 0, length_of(t)
  if length then
    return function()
      while i < length do
        i = i + 1
        local value = rawget(t, i)
        if value ~= nil then return i, value end
      end
    end, t, nil
  end
  local keys = keys_of(t)
  return function()
    while true do
      i = i + 1
      local key = keys[i]
      if key == nil then return nil end
      local value = rawget(t, key)
      if value ~= nil then return key, value end
    end
  end, t, nil
end

function next(t, key)
  if key == nil and raw_next(t) == nil then return nil end
  local keys = keys_of(t)
  for i = 1, #keys do
    if key == nil or comes_before(key, keys[i]) then return keys[i], t[keys[i]] end
  end
  return nil
end

local move = table.move
local function merge_sort(list, first, last, before, spare)
  if last - first < 12 then
    for i = first + 1, last do
      local value, k = list[i], i - 1
      while k >= first and before(value, list[k]) do
        list[k + 1] = list[k]
        k = k - 1
      end
      list[k + 1] = value
    end
    return
  end
  local middle = (first + last) // 2
  merge_sort(list, first, middle, before, spare)
  merge_sort(list, middle + 1, last, before, spare)
  move(list, first, middle, first, spare)
  local i, j, k = first, middle + 1, first
  while i <= middle and j <= last do
    if before(list[j], spare[i]) then
      list[k], j = list[j], j + 1
    else
      list[k], i = spare[i], i + 1
    end
    k = k + 1
  end
  move(spare, i, middle, k, list)
end
function table.sort(list, before)
  if type(list) ~= "table" or #list <= 100 then return sort(list, before) end
  merge_sort(list, 1, #list, before or function(a, b) return a < b end, {})
end

randomseed(seed)
function math.randomseed(number, ...)
  if number == nil then return randomseed(seed) end
  return randomseed(number, ...)
end
local time = os.time
function os.time(at) return at and time(at) or floor(clock()) end
function os.clock() return clock() end
function os.date(format, at) return date(format or "%c", at or floor(clock())) end
function print(...)
  local words = {}
  for i = 1, select("#", ...) do words[i] = tostring((select(i, ...))) end
  log(table.concat(words, "\t"))
end

math.atan2 = math.atan2 or math.atan
math.pow = math.pow or function(x, y) return x ^ y end
unpack = unpack or table.unpack
loadstring = loadstring or load
)";

// Runs after the prelude unless the user trusts the experiment. Functions that start programs, change files, read files
// outside the script's folder, or load machine code or bytecode fail with the cure. Bytecode can break out of Lua, and
// the debug library can reach hidden values.
constexpr const char* kLimits = R"lua(
local beside = ...
local raw_open, raw_lines, raw_load, raw_loadfile, searchpath = io.open, io.lines, load, loadfile, package.searchpath
local type, error, pairs = type, error, pairs
local cure = " unless the user trusts the experiment: --trust (docs/security.md)"

local function limit(library, name, kept)
  local names = {}
  for key, value in pairs(library) do
    if not kept[key] then names[#names + 1] = key end
  end
  for i = 1, #names do
    local key = names[i]
    library[key] = type(library[key]) == "function" and function()
      error(name .. "." .. key .. " is not for scripts" .. cure, 2)
    end or nil
  end
end

local function path_of(name)
  if type(name) ~= "string" then error("the name of a file must be given", 3) end
  local path = beside(name)
  if not path then error("'" .. name .. "' is not below the folder of the script, whose files alone can be read" .. cure, 3) end
  return path
end

limit(os, "os", {time = true, clock = true, date = true, difftime = true, getenv = true})
limit(io, "io", {open = true, lines = true, write = true, type = true, close = true, stdout = true, stderr = true})
limit(debug, "debug", {traceback = true, getinfo = true})
limit(package, "package", {path = true, config = true, loaded = true, preload = true, searchers = true})

function io.open(name, mode)
  local path = path_of(name)
  if mode ~= nil and mode ~= "r" and mode ~= "rb" then error("'" .. name .. "' can only be read," .. cure, 2) end
  return raw_open(path, mode)
end
function io.lines(name, ...) return raw_lines(path_of(name), ...) end
function load(chunk, name, mode, ...) return raw_load(chunk, name, "t", ...) end
loadstring = load
function loadfile(name, mode, ...) return raw_loadfile(path_of(name), "t", ...) end
function dofile(name)
  local chunk, problem = raw_loadfile(path_of(name), "t")
  if not chunk then error(problem, 2) end
  return chunk()
end
package.searchers[2] = function(name)
  local found, problem = searchpath(name, package.path)
  if not found then return problem end
  local path = beside(found)
  if not path then return "\n\t'" .. found .. "' is not below the folder of the script, whose modules alone are loaded" .. cure end
  local chunk, mistake = raw_loadfile(path, "t")
  if not chunk then error("error loading module '" .. name .. "' from file '" .. found .. "':\n\t" .. mistake) end
  return chunk, found
end
package.searchers[3] = nil
package.searchers[4] = nil
)lua";

// Returns the path of a file below the folder of the script; empty if it is elsewhere. Relative names start there, or
// at the working folder.
std::string PathBeside(const LuaScript& script, const std::string& name)
{
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path folder = fs::weakly_canonical(fs::absolute(script.path, none).parent_path(), none);
  fs::path path = folder / name;
  if (!fs::exists(path, none)) path = fs::absolute(name, none);
  if (!fs::exists(path, none)) path = folder / name;
  path = fs::weakly_canonical(path, none);
  const fs::path below = path.lexically_relative(folder);
  return below.empty() || *below.begin() == ".." ? std::string() : path.string();
}

int Beside(lua_State* lua)
{
  const std::string path = PathBeside(Subject<LuaScript>(lua), luaL_checkstring(lua, 1));
  if (path.empty())
    lua_pushnil(lua);
  else
    lua_pushstring(lua, path.c_str());
  return 1;
}

int Clock(lua_State* lua)
{
  lua_pushnumber(lua, Subject<LuaScript>(lua).clock());
  return 1;
}

// Returns n if the keys of a table are 1 to n; otherwise nil.
int LengthOf(lua_State* lua)
{
  lua_Integer length = 0;
  for (lua_pushnil(lua); lua_next(lua, 1) != 0; lua_pop(lua, 1))
    if (lua_isinteger(lua, -2) == 0 || lua_tointeger(lua, -2) != ++length) return 0;
  lua_pushinteger(lua, length);
  return 1;
}

int CallFunction(lua_State* lua)
{
  Subject<const std::function<void()>>(lua)();
  return 0;
}

void Limit(lua_State* lua, LuaScript& script)
{
  luaL_loadbufferx(lua, kLimits, std::char_traits<char>::length(kLimits), "=limits", "t");
  lua_pushlightuserdata(lua, &script);
  lua_pushcclosure(lua, Guarded<Beside>, 1);
  lua_call(lua, 1, 0);
}

// Modules are searched beside the script.
void SearchBeside(lua_State* lua, const LuaScript& script)
{
  const std::string folder = std::filesystem::path(script.path).parent_path().string();
  lua_getglobal(lua, "package");
  lua_pushfstring(lua, "%s/?.lua;%s/?/init.lua;", folder.c_str(), folder.c_str());
  lua_getfield(lua, -2, "path");
  lua_concat(lua, 2);
  lua_setfield(lua, -2, "path");
  Leave(lua);
}

std::string TextOf(const LuaScript& script)
{
  std::ifstream file(script.path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw std::runtime_error("cannot read '" + script.path + "': " + std::strerror(errno));
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  // The first line may be for a shell.
  if (text.starts_with('#')) text.insert(0, "--");
  return text;
}

}  // namespace

void OpenLibraries(lua_State* lua, LuaScript& script, lua_Integer seed)
{
  luaL_openlibs(lua);
  lua_gc(lua, LUA_GCGEN, 0, 0);  // most tables live for one step
  luaL_loadbufferx(lua, kPrelude, std::char_traits<char>::length(kPrelude), "=prelude", "t");
  lua_pushlightuserdata(lua, &script);
  lua_pushcclosure(lua, Guarded<Clock>, 1);
  lua_pushinteger(lua, seed);
  lua_pushcfunction(lua, LengthOf);
  lua_call(lua, 3, 0);
  SearchBeside(lua, script);
  if (!ExperimentsAreTrusted()) Limit(lua, script);
}

void LoadScript(lua_State* lua, const LuaScript& script)
{
  const std::string text = TextOf(script);
  // Messages name the script as the experiment does.
  const std::string name = "@" + script.file;
  if (luaL_loadbufferx(lua, text.data(), text.size(), name.c_str(), "t") != LUA_OK)
    throw std::runtime_error(lua_tostring(lua, -1));
}

void CallProtected(lua_State* lua, const LuaScript& script, const std::function<void()>& act)
{
  lua_settop(lua, 0);
  lua_pushlightuserdata(lua, const_cast<std::function<void()>*>(&act));
  lua_pushcclosure(lua, Guarded<CallFunction>, 1);
  if (lua_pcall(lua, 0, 0, 0) == LUA_OK) return;
  const char* text = lua_tostring(lua, -1);
  throw std::runtime_error(text == nullptr ? script.file + ": an error that is no text" : text);
}

void CallIfThere(lua_State* lua, const char* name)
{
  if (PushGlobal(lua, name) == LUA_TFUNCTION)
    lua_call(lua, 0, 0);
  else
    Leave(lua);
}

}  // namespace swarmanoid::lua
