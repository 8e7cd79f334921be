// CVisualization, for the error of REGISTER_VISUALIZATION.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/plugins/refused.h>

namespace argos
{

class CVisualization : public CBaseConfigurableResource
{
public:
  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
  // Runs the experiment; never called here.
  virtual void Execute() = 0;
};

}  // namespace argos
