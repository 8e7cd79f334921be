// CCI_Actuator: the base of all actuators.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

class CCI_Actuator : public CBaseConfigurableResource
{
public:
  using TMap = std::map<std::string, CCI_Actuator*>;

  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
};

}  // namespace argos
