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

// The robot program uses a driver as the simulator uses an implementation of a device, and the catalogue treats it as
// one.
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
