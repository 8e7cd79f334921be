#include "controller_host/device.h"

#include <map>
#include <utility>

namespace swarmanoid
{
namespace
{

std::map<std::pair<PluginKind, std::string>, const CCI_Columns*>& ColumnsByType()
{
  static std::map<std::pair<PluginKind, std::string>, const CCI_Columns*> columns;
  return columns;
}

}  // namespace

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

const CCI_Columns* FindColumns(PluginKind kind, const std::string& label)
{
  const auto found = ColumnsByType().find({kind, label});
  return found == ColumnsByType().end() ? nullptr : found->second;
}

void SetColumns(PluginKind kind, const std::string& label, const CCI_Columns* columns)
{
  if (columns != nullptr) ColumnsByType()[{kind, label}] = columns;
}

}  // namespace swarmanoid
