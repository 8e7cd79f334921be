// Each robot has an interpreter of its own, in which the script is run once; then step() is called in each control
// step, with the readings written to the table `robot` before. Scripts often declare more sensors than they use, so a
// sensor is read from the moment on at which the script first asks for its field of `robot`.
#include "argos3/plugin/lua_controller.h"

#include <argos3/core/utility/math/rng.h>
#include <argos3/core/wrappers/lua/lua_controller.h>

#include <cmath>
#include <set>

#include "argos3/plugin/lua_devices.h"
#include "argos3/plugin/lua_vectors.h"
#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

namespace
{

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
  template <void (LuaController::*Act)()>
  void Run()
  {
    try
    {
      lua::CallProtected(lua_, script_, [this] { (this->*Act)(); });
    }
    catch (const std::runtime_error& error)
    {
      THROW_ARGOSEXCEPTION(error.what());
    }
  }

  void Begin()
  {
    lua_pushglobaltable(lua_);
    SetFunction<Say>(lua_, "log", &argos::LOG);
    SetFunction<Say>(lua_, "logerr", &argos::LOGERR);
    AddVectors(lua_);
    Leave(lua_);
    // robot.random has a separate generator.
    lua::OpenLibraries(lua_, script_, argos::CRandom::CreateRNG("argos")->Uniform(argos::CRange<SInt32>(0, 1 << 30)));
    MakeRobot();
    lua::LoadScript(lua_, script_);
    Execute();
    lua::CallIfThere(lua_, "init");
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
      sensors_.push_back({tag, sensor, FieldsOf(tag, *sensor)});
    }
    for (const auto& [type, actuator] : script_.actuators)
    {
      Enter(lua_, type.c_str());
      lua::AddSetter(lua_, *actuator);
      Leave(lua_);
    }
    ReadOwnSensors();
    Enter(lua_, "params");
    for (const ticpp::Attribute& parameter : params_)
    {
      lua_pushlstring(lua_, parameter.Value().data(), parameter.Value().size());
      lua_setfield(lua_, -2, parameter.Name().c_str());
    }
    Leave(lua_);
    HideSensors();
    lua_setglobal(lua_, "robot");
  }

  // The fields of `robot` that a sensor writes.
  std::set<std::string> FieldsOf(const std::string& tag, argos::CCI_Sensor& sensor)
  {
    std::set<std::string> fields;
    lua_newtable(lua_);
    AddReadings(lua_, tag, sensor);
    for (lua_pushnil(lua_); lua_next(lua_, -2) != 0; lua_pop(lua_, 1)) fields.insert(lua_tostring(lua_, -2));
    Leave(lua_);
    return fields;
  }

  // Moves the fields of sensors from `robot`, which is on top of the stack, to a table of their own, where Lua finds
  // them by its event `index`.
  void HideSensors()
  {
    lua_newtable(lua_);
    for (const Sensor& sensor : sensors_)
      for (const std::string& field : sensor.fields)
      {
        lua_getfield(lua_, -2, field.c_str());
        if (!lua_isnil(lua_, -1))
          lua_setfield(lua_, -2, field.c_str());
        else
          Leave(lua_);
        lua_pushnil(lua_);
        lua_setfield(lua_, -3, field.c_str());
      }
    hidden_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
    lua_newtable(lua_);
    SetFunction<FirstUse>(lua_, "__index", this);
    SetFunction<Pairs>(lua_, "__pairs", this);
    lua_setmetatable(lua_, -2);
  }

  // Called when the script reads a field of `robot` that is not there: a sensor's field that was not used yet, or nil.
  static int FirstUse(lua_State* lua)
  {
    if (lua_type(lua, 2) != LUA_TSTRING) return 0;
    lua_settop(lua, 2);
    Subject<LuaController>(lua).Show(lua, lua_tostring(lua, 2));
    lua_settop(lua, 2);
    lua_rawget(lua, 1);
    return 1;
  }

  // A script that goes through all fields uses all.
  static int Pairs(lua_State* lua)
  {
    auto& controller = Subject<LuaController>(lua);
    lua_settop(lua, 1);
    for (const Sensor& sensor : controller.sensors_)
      for (const std::string& field : sensor.fields) controller.Show(lua, field);
    lua_settop(lua, 1);
    lua_getglobal(lua, "next");
    lua_pushvalue(lua, 1);
    lua_pushnil(lua);
    return 3;
  }

  // Puts a hidden field into `robot`, which is at index 1 of the stack, and reads its sensors.
  void Show(lua_State* lua, const std::string& field)
  {
    lua_rawgeti(lua, LUA_REGISTRYINDEX, hidden_);
    if (lua_getfield(lua, -1, field.c_str()) == LUA_TNIL) return;
    lua_pushvalue(lua, 1);
    lua_insert(lua, -2);
    lua_setfield(lua, -2, field.c_str());
    Leave(lua);
    lua_pushnil(lua);
    lua_setfield(lua, -2, field.c_str());
    Leave(lua);
    for (Sensor& sensor : sensors_)
    {
      if (!sensor.fields.contains(field)) continue;
      sensor.is_used = true;
      lua_pushvalue(lua, 1);
      AddReadings(lua, sensor.tag, *sensor.sensor);
      Leave(lua);
    }
  }

  void Execute()
  {
    lua_call(lua_, 0, 0);
    if (lua_getglobal(lua_, "step") != LUA_TFUNCTION)
      luaL_error(lua_, "%s: the script has no function step()", script_.file.c_str());
    Leave(lua_);
  }

  void Step()
  {
    lua_getglobal(lua_, "robot");
    // A script may have replaced the table.
    if (lua_istable(lua_, -1))
    {
      for (const Sensor& sensor : sensors_)
        if (sensor.is_used) AddReadings(lua_, sensor.tag, *sensor.sensor);
      ReadOwnSensors();
    }
    Leave(lua_);
    lua_getglobal(lua_, "step");
    lua_call(lua_, 0, 0);
  }

  void ReadOwnSensors()
  {
    for (auto& [type, sensor] : script_.sensors)
    {
      Enter(lua_, type.c_str());
      sensor.Read(lua_);
      Leave(lua_);
    }
  }

  void Again() { lua::CallIfThere(lua_, "reset"); }
  void End() { lua::CallIfThere(lua_, "destroy"); }

  LuaScript script_;
  lua_State*& lua_ = m_ptLuaState;
  argos::CRandom::CRNG* random_ = nullptr;
  std::vector<ticpp::Attribute> params_;
  struct Sensor
  {
    std::string tag;
    argos::CCI_Sensor* sensor;
    std::set<std::string> fields;  // of `robot`
    bool is_used = false;
  };
  std::vector<Sensor> sensors_;
  int hidden_ = LUA_NOREF;  // the fields that were not used yet
};

}  // namespace

std::unique_ptr<argos::CCI_Controller> MakeLuaController(LuaScript script)
{
  return std::make_unique<LuaController>(std::move(script));
}

}  // namespace swarmanoid::argos3
