// CCI_Sensor: the base of all sensors.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

class CCI_Sensor : public CBaseConfigurableResource
{
public:
  using TMap = std::map<std::string, CCI_Sensor*>;

  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
  // Switches the sensor on.
  virtual void Enable() { enabled_ = true; }
  // Switches the sensor off. Among the sensors that come with the simulator only the cameras heed it: a camera that is
  // off reports no blobs. Every other sensor goes on reading.
  virtual void Disable() { enabled_ = false; }
  bool IsEnabled() const { return enabled_; }
  bool IsDisabled() const { return !enabled_; }

protected:
  bool enabled_ = true;
};

}  // namespace argos
