// CCI_Sensor: the base of all sensors.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

// Reads for a sensor of the simulator.
class CSensorReader
{
public:
  virtual ~CSensorReader() = default;
  // Updates the readings. Called at most once for each ReadOnDemand.
  virtual void Read() = 0;
};

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
  // Has the reader read once, when the readings are next asked for.
  void ReadOnDemand(CSensorReader& reader) { reader_ = &reader; }

protected:
  // The getters of readings call this first.
  void Demand() const
  {
    if (reader_ == nullptr) return;
    CSensorReader& reader = *reader_;
    reader_ = nullptr;
    reader.Read();
  }

  bool enabled_ = true;

private:
  mutable CSensorReader* reader_ = nullptr;
};

}  // namespace argos
