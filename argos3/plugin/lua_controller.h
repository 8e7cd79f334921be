// <lua_controller>: ARGoS3's controllers in Lua. The documentation of the table `robot` is at
// https://www.argos-sim.info/plow2015/ and in the headers of the interfaces under src/plugins/robots of ARGoS3's
// sources.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>

#include <map>
#include <memory>
#include <string>

#include "controller_host/scripts/lua/lua_columns.h"
#include "controller_host/scripts/lua/lua_libraries.h"

namespace swarmanoid::argos3
{

struct LuaScript : lua::LuaScript
{
  // The devices that ARGoS3 does not have, by type.
  std::map<std::string, lua::SensorTable> sensors{};
  std::map<std::string, CCI_Actuator*> actuators{};
};

// Returns a controller whose Init runs the script and its init(). Init and ControlStep throw CARGoSException with file
// and line of the script.
std::unique_ptr<argos::CCI_Controller> MakeLuaController(LuaScript script);

}  // namespace swarmanoid::argos3
