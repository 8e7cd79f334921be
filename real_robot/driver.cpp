#include "real_robot/driver.h"

#include <utility>

namespace swarmanoid
{

PluginDescription DescribeDriver(const std::string& type, const std::string& name, const std::string& brief,
                                 std::vector<std::string> robots, std::vector<ParameterSpec> parameters)
{
  PluginDescription description;
  description.label = type;
  description.implementation = name;
  description.brief = brief;
  description.robots = std::move(robots);
  description.parameters = std::move(parameters);
  return description;
}

// A driver is to the robot program what an implementation of a device is to the simulator, and is catalogued as such.
template <>
PluginRegistry<CSensorDriver>& PluginRegistry<CSensorDriver>::Instance()
{
  static PluginRegistry registry(PluginKind::kSensor);
  return registry;
}

template <>
PluginRegistry<CActuatorDriver>& PluginRegistry<CActuatorDriver>::Instance()
{
  static PluginRegistry registry(PluginKind::kActuator);
  return registry;
}

}  // namespace swarmanoid
