#include "controller_host/device.h"

namespace swarmanoid
{

template <>
PluginRegistry<SensorBatch>& PluginRegistry<SensorBatch>::Instance()
{
  static PluginRegistry registry(PluginKind::kSensor);
  return registry;
}

template <>
PluginRegistry<ActuatorBatch>& PluginRegistry<ActuatorBatch>::Instance()
{
  static PluginRegistry registry(PluginKind::kActuator);
  return registry;
}

}  // namespace swarmanoid
