// Each robot has an interpreter of its own, in which the script is run once; then step() is called in each control
// step, with the readings written to the table `robot` before. Scripts must give the same run in every process,
// although Lua orders tables by addresses, so a prelude replaces what depends on addresses or on the time of day.
// Scripts of strangers may not harm the user's machine, so a second text takes away the functions that could.
//
// Errors of Lua are raised by longjmp, which must not cross C++ objects with destructors: every function that Lua calls
// goes through Guarded, which turns exceptions into errors of Lua, and each entry from C++ is a protected call.
#include "argos3/plugin/lua_controller.h"

#include <argos3/core/utility/math/rng.h>
#include <argos3/core/wrappers/lua/lua_controller.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "argos3/plugin/lua_devices.h"
#include "argos3/plugin/lua_stack.h"
#include "argos3/plugin/lua_vectors.h"
#include "common/configuration/trust.h"

namespace swarmanoid::argos3
{
namespace
{

// Runs before the script, with the clock and a seed. Lua seeds its tables and random numbers from addresses and the
// time of day. Here the same script does the same in every process:
//   - pairs() and next() visit numbers, then texts, in ascending order;
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

// The next functions are those of robot.random, the functions of CRandom.

int Uniform(lua_State* lua)
{
  auto& random = Subject<argos::CRandom::CRNG>(lua);
  const int count = lua_gettop(lua);
  if (count > 2) return luaL_error(lua, "random.uniform has no, one or two values");
  const double low = count == 2 ? luaL_checknumber(lua, 1) : 0;
  const double high = count == 0 ? 1 : luaL_checknumber(lua, count);
  lua_pushnumber(lua, random.Uniform(argos::CRange<Real>(low, high)));
  return 1;
}

int UniformInt(lua_State* lua)
{
  auto& random = Subject<argos::CRandom::CRNG>(lua);
  const int count = lua_gettop(lua);
  if (count != 1) CheckCount(lua, 2);
  const double low = count == 2 ? std::floor(luaL_checknumber(lua, 1)) : 0;
  const double high = std::floor(luaL_checknumber(lua, count));
  if (!(std::abs(low) <= 1e9 && std::abs(high) <= 1e9)) return luaL_error(lua, "a limit is beyond a thousand million");
  lua_pushinteger(lua, random.Uniform(argos::CRange<SInt32>(static_cast<SInt32>(low), static_cast<SInt32>(high))));
  return 1;
}

int Bernoulli(lua_State* lua)
{
  lua_pushinteger(lua, Subject<argos::CRandom::CRNG>(lua).Bernoulli(luaL_optnumber(lua, 1, 0.5)) ? 1 : 0);
  return 1;
}

int Exponential(lua_State* lua)
{
  lua_pushnumber(lua, Subject<argos::CRandom::CRNG>(lua).Exponential(luaL_checknumber(lua, 1)));
  return 1;
}

int Poisson(lua_State* lua)
{
  lua_pushinteger(lua, Subject<argos::CRandom::CRNG>(lua).Poisson(luaL_checknumber(lua, 1)));
  return 1;
}

int Gaussian(lua_State* lua)
{
  lua_pushnumber(lua, Subject<argos::CRandom::CRNG>(lua).Gaussian(luaL_checknumber(lua, 1), luaL_optnumber(lua, 2, 0)));
  return 1;
}

int Say(lua_State* lua)
{
  auto& log = Subject<argos::CARGoSLog>(lua);
  for (int i = 1; i <= lua_gettop(lua); ++i)
  {
    switch (lua_type(lua, i))
    {
      case LUA_TBOOLEAN:
        log << (lua_toboolean(lua, i) != 0);
        break;
      case LUA_TNUMBER:
        log << lua_tonumber(lua, i);
        break;
      case LUA_TSTRING:
        log << lua_tostring(lua, i);
        break;
      default:
        log << luaL_typename(lua, i);
    }
  }
  log << std::endl;
  return 0;
}

int Clock(lua_State* lua)
{
  lua_pushnumber(lua, Subject<std::function<double()>>(lua)());
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

class LuaController final : public argos::CLuaController
{
public:
  explicit LuaController(LuaScript script) : script_(std::move(script)) {}
  ~LuaController() override
  {
    if (lua_ != nullptr) lua_close(lua_);
  }

  void Init(argos::TConfigurationNode& params) override
  {
    params_ = params.Attributes();
    random_ = argos::CRandom::CreateRNG("argos");
    lua_ = luaL_newstate();
    if (lua_ == nullptr) THROW_ARGOSEXCEPTION("no memory is left for Lua");
    Run<&LuaController::Begin>();
  }
  void ControlStep() override { Run<&LuaController::Step>(); }
  void Reset() override { Run<&LuaController::Again>(); }
  void Destroy() override { Run<&LuaController::End>(); }

private:
  // Catches errors of Lua, including lack of memory.
  template <void (LuaController::*Act)()>
  void Run()
  {
    lua_settop(lua_, 0);
    lua_pushlightuserdata(lua_, this);
    lua_pushcclosure(lua_, Guarded<Call<Act>>, 1);
    if (lua_pcall(lua_, 0, 0, 0) == LUA_OK) return;
    const char* text = lua_tostring(lua_, -1);
    THROW_ARGOSEXCEPTION((text == nullptr ? script_.file + ": an error that is no text" : std::string(text)));
  }

  template <void (LuaController::*Act)()>
  static int Call(lua_State* lua)
  {
    (Subject<LuaController>(lua).*Act)();
    return 0;
  }

  void Begin()
  {
    luaL_openlibs(lua_);
    lua_gc(lua_, LUA_GCGEN, 0, 0);  // most tables live for one step
    lua_pushglobaltable(lua_);
    SetFunction<Say>(lua_, "log", &argos::LOG);
    SetFunction<Say>(lua_, "logerr", &argos::LOGERR);
    AddVectors(lua_);
    Leave(lua_);
    luaL_loadbufferx(lua_, kPrelude, std::char_traits<char>::length(kPrelude), "=prelude", "t");
    lua_pushlightuserdata(lua_, &script_.clock);
    lua_pushcclosure(lua_, Guarded<Clock>, 1);
    // robot.random has a separate generator.
    lua_pushinteger(lua_, argos::CRandom::CreateRNG("argos")->Uniform(argos::CRange<SInt32>(0, 1 << 30)));
    lua_pushcfunction(lua_, LengthOf);
    lua_call(lua_, 3, 0);
    SearchBeside();
    if (!ExperimentsAreTrusted()) Limit();
    MakeRobot();
    Load();
    Execute();
    CallIfThere("init");
  }

  void Limit()
  {
    luaL_loadbufferx(lua_, kLimits, std::char_traits<char>::length(kLimits), "=limits", "t");
    lua_pushlightuserdata(lua_, &script_);
    lua_pushcclosure(lua_, Guarded<Beside>, 1);
    lua_call(lua_, 1, 0);
  }

  // Modules are searched beside the script.
  void SearchBeside()
  {
    const std::string folder = std::filesystem::path(script_.path).parent_path().string();
    lua_getglobal(lua_, "package");
    lua_pushfstring(lua_, "%s/?.lua;%s/?/init.lua;", folder.c_str(), folder.c_str());
    lua_getfield(lua_, -2, "path");
    lua_concat(lua_, 2);
    lua_setfield(lua_, -2, "path");
    Leave(lua_);
  }

  void MakeRobot()
  {
    lua_newtable(lua_);
    lua_pushstring(lua_, GetId().c_str());
    lua_setfield(lua_, -2, "id");
    Enter(lua_, "random");
    SetFunction<Uniform>(lua_, "uniform", random_);
    SetFunction<UniformInt>(lua_, "uniform_int", random_);
    SetFunction<Bernoulli>(lua_, "bernoulli", random_);
    SetFunction<Exponential>(lua_, "exponential", random_);
    SetFunction<Poisson>(lua_, "poisson", random_);
    SetFunction<Gaussian>(lua_, "gaussian", random_);
    Leave(lua_);
    for (const auto& [tag, actuator] : GetAllActuators()) AddFunctions(lua_, tag, *actuator);
    for (const auto& [tag, sensor] : GetAllSensors())
    {
      AddFunctions(lua_, tag, *sensor);
      AddReadings(lua_, tag, *sensor);
    }
    for (const auto& [type, actuator] : script_.actuators) AddColumns(lua_, type, *actuator);
    for (const auto& [type, sensor] : script_.sensors) ReadColumns(lua_, type, *sensor);
    Enter(lua_, "params");
    for (const ticpp::Attribute& parameter : params_)
    {
      lua_pushlstring(lua_, parameter.Value().data(), parameter.Value().size());
      lua_setfield(lua_, -2, parameter.Name().c_str());
    }
    Leave(lua_);
    lua_setglobal(lua_, "robot");
  }

  // Messages name the script as the experiment does.
  void Load()
  {
    const std::string text = TextOfScript();
    const std::string name = "@" + script_.file;
    if (luaL_loadbufferx(lua_, text.data(), text.size(), name.c_str(), "t") != LUA_OK)
      THROW_ARGOSEXCEPTION(lua_tostring(lua_, -1));
  }

  void Execute()
  {
    lua_call(lua_, 0, 0);
    if (lua_getglobal(lua_, "step") != LUA_TFUNCTION)
      luaL_error(lua_, "%s: the script has no function step()", script_.file.c_str());
    Leave(lua_);
  }

  std::string TextOfScript() const
  {
    std::ifstream file(script_.path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file) THROW_ARGOSEXCEPTION("cannot read '" << script_.path << "': " << std::strerror(errno));
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    // The first line may be for a shell.
    if (text.starts_with('#')) text.insert(0, "--");
    return text;
  }

  void CallIfThere(const char* name)
  {
    if (lua_getglobal(lua_, name) == LUA_TFUNCTION)
      lua_call(lua_, 0, 0);
    else
      Leave(lua_);
  }

  void Step()
  {
    lua_getglobal(lua_, "robot");
    // A script may have replaced the table.
    if (lua_istable(lua_, -1))
    {
      for (const auto& [tag, sensor] : GetAllSensors()) AddReadings(lua_, tag, *sensor);
      for (const auto& [type, sensor] : script_.sensors) ReadColumns(lua_, type, *sensor);
    }
    Leave(lua_);
    lua_getglobal(lua_, "step");
    lua_call(lua_, 0, 0);
  }

  void Again() { CallIfThere("reset"); }
  void End() { CallIfThere("destroy"); }

  LuaScript script_;
  lua_State*& lua_ = m_ptLuaState;
  argos::CRandom::CRNG* random_ = nullptr;
  std::vector<ticpp::Attribute> params_;
};

}  // namespace

std::unique_ptr<argos::CCI_Controller> MakeLuaController(LuaScript script)
{
  return std::make_unique<LuaController>(std::move(script));
}

}  // namespace swarmanoid::argos3
