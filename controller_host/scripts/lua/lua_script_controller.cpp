// <lua_controller library="lua"> runs a script for each robot (docs/scripts.md):
//
//   <lua_controller id="walk" library="lua">
//     <actuators>…</actuators> <sensors>…</sensors>
//     <parameters script="walk.lua" speed="0.1"/>
//   </lua_controller>
//
// Each robot has an interpreter, which runs the script once and then step() in each control step. A sensor that the
// script has used is read before each step, so that tables that the script keeps are up to date.
#include <cmath>
#include <istream>
#include <iterator>
#include <memory>
#include <ostream>
#include <vector>

#include "common/configuration/trust.h"
#include "common/control_interface/ci_controller.h"
#include "common/plugins/script_parameters.h"
#include "controller_host/scripts/declaration/script_declaration.h"
#include "controller_host/scripts/lua/lua_columns.h"
#include "controller_host/scripts/lua/lua_libraries.h"
#include "controller_host/scripts/lua/lua_parameters.h"
#include "controller_host/scripts/lua/lua_stack.h"
#include "controller_host/scripts/lua/lua_values.h"

namespace swarmanoid::lua
{
namespace
{

constexpr const char* kState = "state";
constexpr const char* kRobot = "robot";
constexpr double kMostIntegers = 4294967295.0;  // of a random integer

// The next functions draw from the stream of the robot's step.

int Uniform(lua_State* lua)
{
  CheckCount(lua, 2);
  const double low = luaL_checknumber(lua, 1), high = luaL_checknumber(lua, 2);
  lua_pushnumber(lua, Subject<CCI_Robot>(lua).GetRandom().Uniform(low, high));
  return 1;
}

int Gaussian(lua_State* lua)
{
  const double mean = luaL_optnumber(lua, 1, 0), deviation = luaL_optnumber(lua, 2, 1);
  lua_pushnumber(lua, Subject<CCI_Robot>(lua).GetRandom().Gaussian(mean, deviation));
  return 1;
}

int Bernoulli(lua_State* lua)
{
  const double probability = luaL_checknumber(lua, 1);
  lua_pushboolean(lua, Subject<CCI_Robot>(lua).GetRandom().Uniform() < probability ? 1 : 0);
  return 1;
}

// math.random: a number in [0, 1), or an integer from 1, or from a first argument, to the last argument.
int MathRandom(lua_State* lua)
{
  RandomStream& random = Subject<CCI_Robot>(lua).GetRandom();
  const int count = lua_gettop(lua);
  if (count == 0)
  {
    lua_pushnumber(lua, random.Uniform());
    return 1;
  }
  if (count > 2) return luaL_error(lua, "math.random has no, one or two values");
  const lua_Integer low = count == 2 ? luaL_checkinteger(lua, 1) : 1;
  const lua_Integer high = luaL_checkinteger(lua, count);
  const double range = static_cast<double>(high) - static_cast<double>(low);
  if (range < 0) return luaL_error(lua, "the interval of math.random is empty");
  if (range >= kMostIntegers) return luaL_error(lua, "the interval of math.random has more than 2^32 - 1 integers");
  lua_pushinteger(lua, low + random.Below(static_cast<std::uint32_t>(high - low) + 1));
  return 1;
}

int MathRandomSeed(lua_State* lua)
{
  return luaL_error(lua, "random numbers are those of the robot and cannot be seeded; the experiment has the seed");
}

int Say(lua_State* lua)
{
  const int count = lua_gettop(lua);
  luaL_checkstack(lua, count, "too many values");
  for (int i = 1; i <= count; ++i) luaL_tolstring(lua, i, nullptr);
  lua_concat(lua, count);
  Subject<CCI_Robot>(lua).Log(lua_tostring(lua, -1));
  return 0;
}

class LuaScriptController final : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    parameters_ = t_tree;
    const std::string path = t_tree.GetText(kScriptParameter);
    script_ = {ShownScript(path), path, [robot = GetRobot()] { return robot->GetTime(); }};
    lua_.reset(luaL_newstate());
    if (lua_ == nullptr) throw std::runtime_error("no memory is left for Lua");
    MakeDevices();
    Run<&LuaScriptController::Begin>();
    if (has_state_) after_init_ = ValuesOfScript(lua_.get(), known_);
    return RETURN_OK;
  }
  void ControlStep() override { Run<&LuaScriptController::Step>(); }
  void Destroy() override { Run<&LuaScriptController::End>(); }

  bool HasState() const override { return has_state_; }
  void SaveState(std::ostream& out) const override
  {
    RequireNothingElse();
    lua_settop(lua_.get(), 0);
    if (PushGlobal(lua_.get(), kState) != LUA_TTABLE)
      throw std::runtime_error("the global `state` is no table any more");
    out << SavedTable(lua_.get(), 1, kState);
  }
  void LoadState(std::istream& in) override
  {
    const std::string saved(std::istreambuf_iterator<char>(in), {});
    lua_settop(lua_.get(), 0);
    if (PushGlobal(lua_.get(), kState) != LUA_TTABLE)
      throw std::runtime_error("saved state: the script has no `state`");
    LoadTable(lua_.get(), 1, saved);
  }
  std::string StatusText() const override
  {
    lua_settop(lua_.get(), 0);
    if (PushGlobal(lua_.get(), "status") != LUA_TSTRING) return {};
    return lua_tostring(lua_.get(), 1);
  }
  // The interpreters share nothing. A script that may write files could share those.
  bool StepsInParallel() const override { return !ExperimentsAreTrusted(); }

private:
  struct Device
  {
    std::string type;
    std::unique_ptr<SensorTable> sensor;
    CCI_Actuator* actuator = nullptr;
    int table = LUA_NOREF;
    bool is_used = false;
  };

  template <void (LuaScriptController::*Act)()>
  void Run()
  {
    CallProtected(lua_.get(), script_, [this] { (this->*Act)(); });
  }

  void MakeDevices()
  {
    const CCI_Robot& robot = *GetRobot();
    for (const std::string& type : robot.SensorTypes())
      devices_.push_back({type, std::make_unique<SensorTable>(*robot.GetSensor(type))});
    for (const std::string& type : robot.ActuatorTypes())
    {
      Device* device = Find(type);
      if (device == nullptr) device = &devices_.emplace_back(Device{type, nullptr});
      device->actuator = robot.GetActuator(type);
    }
  }

  Device* Find(std::string_view type)
  {
    for (Device& device : devices_)
      if (device.type == type) return &device;
    return nullptr;
  }

  void Begin()
  {
    lua_State* const lua = lua_.get();
    lua_pushglobaltable(lua);
    SetFunction<Say>(lua, "log", GetRobot());
    Leave(lua);
    OpenLibraries(lua, script_, 0);
    lua_getglobal(lua, "math");
    SetFunction<MathRandom>(lua, "random", GetRobot());
    SetFunction<MathRandomSeed>(lua, "randomseed", GetRobot());
    Leave(lua);
    MakeRobot(lua);
    lua_pushglobaltable(lua);
    SetFunction<Parameters>(lua, "parameters", this);
    NoteGlobals(lua);
    Leave(lua);
    LoadScript(lua, script_);
    lua_call(lua, 0, 0);
    if (PushGlobal(lua, "step") != LUA_TFUNCTION)
      luaL_error(lua, "%s: the script has no function step()", script_.file.c_str());
    Leave(lua);
    CallIfThere(lua, "init");
    const int type = PushGlobal(lua, kState);
    if (type != LUA_TNIL && type != LUA_TTABLE)
      luaL_error(lua, "%s: the global `state` is a %s; it must be a table", script_.file.c_str(),
                 lua_typename(lua, type));
    has_state_ = type == LUA_TTABLE;
    Leave(lua);
  }

  // Notes what exists before the script, which is not its state.
  void NoteGlobals(lua_State* lua)
  {
    for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1)) known_.globals.insert(lua_tostring(lua, -2));
    for (const char* name : {kState, kRobot, "status"}) known_.globals.insert(name);
  }

  void MakeRobot(lua_State* lua)
  {
    lua_newtable(lua);
    known_.tables.insert(lua_topointer(lua, -1));
    lua_pushstring(lua, GetRobot()->GetId().c_str());
    lua_setfield(lua, -2, "id");
    lua_pushstring(lua, GetRobot()->GetKind().c_str());
    lua_setfield(lua, -2, "kind");
    Set(lua, "tick_seconds", GetRobot()->GetTickSeconds());
    SetTime(lua);
    Enter(lua, "random");
    known_.tables.insert(lua_topointer(lua, -1));
    SetFunction<Uniform>(lua, "uniform", GetRobot());
    SetFunction<Gaussian>(lua, "gaussian", GetRobot());
    SetFunction<Bernoulli>(lua, "bernoulli", GetRobot());
    Leave(lua);
    lua_newtable(lua);
    SetFunction<FirstUse>(lua, "__index", this);
    SetFunction<NewField>(lua, "__newindex", this);
    lua_setmetatable(lua, -2);
    lua_setglobal(lua, kRobot);
    for (Device& device : devices_)
    {
      lua_newtable(lua);
      known_.tables.insert(lua_topointer(lua, -1));
      if (device.actuator != nullptr) AddSetter(lua, *device.actuator);
      device.table = luaL_ref(lua, LUA_REGISTRYINDEX);
    }
  }

  void SetTime(lua_State* lua)
  {
    lua_pushinteger(lua, static_cast<lua_Integer>(GetRobot()->GetTick()));
    lua_setfield(lua, -2, "tick");
    Set(lua, "time", GetRobot()->GetTime());
  }

  // Called when the script reads a field of `robot` that does not exist: a device that was not used yet, or nil.
  static int FirstUse(lua_State* lua)
  {
    auto& controller = Subject<LuaScriptController>(lua);
    if (lua_type(lua, 2) != LUA_TSTRING) return 0;
    Device* device = controller.Find(lua_tostring(lua, 2));
    if (device == nullptr) return 0;
    lua_settop(lua, 2);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, device->table);
    device->is_used = true;
    if (device->sensor != nullptr) device->sensor->Read(lua);
    lua_pushvalue(lua, 2);
    lua_pushvalue(lua, 3);
    lua_rawset(lua, 1);
    return 1;
  }

  static int NewField(lua_State* lua)
  {
    return luaL_error(lua, "the table `robot` takes no new field '%s'; keep it in the table `state`",
                      luaL_tolstring(lua, 2, nullptr));
  }

  // parameters{…} returns the values.
  static int Parameters(lua_State* lua)
  {
    auto& controller = Subject<LuaScriptController>(lua);
    PushValues(lua, ReadDeclaration(lua), controller.parameters_);
    return 1;
  }

  void Step()
  {
    lua_State* const lua = lua_.get();
    PushGlobal(lua, kRobot);
    // A script may have replaced the table.
    if (lua_istable(lua, -1)) SetTime(lua);
    Leave(lua);
    for (Device& device : devices_)
    {
      if (!device.is_used || device.sensor == nullptr) continue;
      lua_rawgeti(lua, LUA_REGISTRYINDEX, device.table);
      device.sensor->Read(lua);
      Leave(lua);
    }
    PushGlobal(lua, "step");
    lua_call(lua, 0, 0);
  }

  void End() { CallIfThere(lua_.get(), "destroy"); }

  // The script goes on from `state` alone, so nothing else may have changed since its start.
  void RequireNothingElse() const
  {
    for (const auto& [name, value] : ValuesOfScript(lua_.get(), known_))
    {
      const auto before = after_init_.find(name);
      if (before == after_init_.end() || before->second != value)
        throw std::runtime_error(script_.file + ": " + name +
                                 " has changed since the start of the script and would not be restored; keep it in " +
                                 "the table `state`, or in a local variable of step()");
    }
  }

  TConfigurationTree parameters_;
  LuaScript script_;
  std::vector<Device> devices_;
  std::unique_ptr<lua_State, decltype(&lua_close)> lua_{nullptr, lua_close};
  bool has_state_ = false;
  KnownValues known_;
  std::map<std::string, std::string> after_init_;
};

std::vector<ParameterSpec> ParametersOfScript(const TConfigurationTree& parameters, const std::string& folder)
{
  return ReadScriptDeclaration(parameters, folder,
                               [](const std::string& file, const std::string& path) {
                                 return DeclaredParameters({file, path, [] { return 0.0; }});
                               });
}

const ControllerRegistration registration(
    []() -> std::unique_ptr<CCI_Controller> { return std::make_unique<LuaScriptController>(); }, "LuaScriptController",
    PluginDescription{
        .label = "lua_controller",
        .brief = "runs a script in Lua, which declares more parameters",
        .parameters = {{.name = kScriptParameter, .type = ParameterType::kPath, .description = "The script."}}});

const bool declares = []
{
  ScriptParameters::Instance().Add("lua_controller", ParametersOfScript);
  return true;
}();

}  // namespace
}  // namespace swarmanoid::lua
