// <lua_controller>: ARGoS3's controllers in Lua. Its documentation of the table `robot`:
// https://www.argos-sim.info/plow2015/ and the interfaces' headers under src/plugins/robots of its sources.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid::argos3
{

struct LuaScript
{
  std::string file;  // as messages name it
  std::string path;
  // Simulated time, s.
  std::function<double()> clock;
  // The devices that ARGoS3 does not have, by type.
  std::map<std::string, CCI_Sensor*> sensors{};
  std::map<std::string, CCI_Actuator*> actuators{};
};

// Its Init runs the script and its init(). Init and ControlStep throw CARGoSException with file and line of the script.
std::unique_ptr<argos::CCI_Controller> MakeLuaController(LuaScript script);

}  // namespace swarmanoid::argos3
