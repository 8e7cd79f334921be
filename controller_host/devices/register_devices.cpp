#include <vector>

#include "common/plugin_descriptions/describe_builtins.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

std::vector<void (*)()>& CodeOfDevices()
{
  static std::vector<void (*)()> all;
  return all;
}

}  // namespace

DeviceCode::DeviceCode(void (*bind)()) { CodeOfDevices().push_back(bind); }

void RegisterBuiltinDevices()
{
  static const bool registered = []
  {
    DescribeBuiltinDevices();
    for (void (*const bind)() : CodeOfDevices()) bind();
    PluginRegistry<SensorBatch>::Instance().RequireCode();
    PluginRegistry<ActuatorBatch>::Instance().RequireCode();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
