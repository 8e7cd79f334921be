#include "controller_host/device.h"

namespace swarmanoid
{

template <>
PluginRegistry<SensorBatch>& PluginRegistry<SensorBatch>::Instance()
{
  static PluginRegistry registry;
  return registry;
}

template <>
PluginRegistry<ActuatorBatch>& PluginRegistry<ActuatorBatch>::Instance()
{
  static PluginRegistry registry;
  return registry;
}

template class PluginRegistry<SensorBatch>;
template class PluginRegistry<ActuatorBatch>;

}  // namespace swarmanoid
