// CBaseConfigurableResource: an object with Init, Reset and Destroy.
#pragma once

#include <argos3/core/utility/configuration/argos_configuration.h>

namespace argos
{

class CBaseConfigurableResource
{
public:
  virtual ~CBaseConfigurableResource() = default;
  // Prepares the object from its element of the experiment file. Throws CARGoSException for mistakes.
  virtual void Init(TConfigurationNode&) = 0;
  // Restores the state after Init, for a new trial.
  virtual void Reset() = 0;
  // Releases what Init acquired. It is called once, at the end.
  virtual void Destroy() = 0;
};

}  // namespace argos
