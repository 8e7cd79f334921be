// CBaseConfigurableResource: an object with Init, Reset and Destroy.
#pragma once

#include <argos3/core/utility/configuration/argos_configuration.h>

namespace argos
{

class CBaseConfigurableResource
{
public:
  virtual ~CBaseConfigurableResource() = default;
  virtual void Init(TConfigurationNode&) = 0;
  virtual void Reset() = 0;
  virtual void Destroy() = 0;
};

}  // namespace argos
