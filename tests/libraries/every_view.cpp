// A sensor and an actuator as a user's library has them: their columns are declared here and nowhere else, and
// tests/python/views_test.py finds them in every view.
#include <array>
#include <string>
#include <vector>

#include "controller_host/device.h"
#include "controller_host/devices/value_devices.h"

using namespace swarmanoid;

struct Echo
{
  std::string id;
  double angle_rad;
};

class CCI_EveryViewSensor : public CCI_SensorOf<CCI_EveryViewSensor>
{
public:
  virtual double GetTick() const = 0;
  std::array<double, 2> GetPair() const { return {GetTick() + 0.25, GetTick() + 0.5}; }
  std::vector<Echo> GetEchoes() const { return {{"left", 1.5}, {"right", -1.5}}; }

  static void Declare(Declaration& columns)
  {
    columns.Add({"count", "ticks", 0}, &CCI_EveryViewSensor::GetTick)
        .Add({"#", "m"}, &CCI_EveryViewSensor::GetPair)
        .AddRows("echo", &CCI_EveryViewSensor::GetEchoes, CCI_Field({"angle", "rad"}, &Echo::angle_rad),
                 CCI_Field({"is left", "yes/no", 0, 1}, [](const Echo& echo) { return echo.angle_rad > 0; }))
        .AddRowIds(&CCI_EveryViewSensor::GetEchoes, &Echo::id);
  }
};

class CCI_EveryViewActuator : public CCI_ActuatorOf<CCI_EveryViewActuator>
{
public:
  virtual void SetLevels(double low, double high) = 0;
  static void Declare(Declaration& columns)
  {
    columns.Set({{"low", "V"}, {"high", "V"}}, &CCI_EveryViewActuator::SetLevels);
  }
};

class EveryViewReading : public CCI_EveryViewSensor
{
public:
  explicit EveryViewReading(const double* tick) : tick_(tick) {}
  double GetTick() const override { return *tick_; }

private:
  const double* tick_;
};

class EveryViewSensor : public SensorsOf<ValueSensor, EveryViewReading>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 1);
    MakeDevices();
  }
  void Update(const ChannelView&) override
  {
    for (double& value : values_) value = static_cast<double>(space_->GetTick());
  }
};

class EveryViewLevels : public CommandsOf<CCI_EveryViewActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SetLevels(double low, double high) override
  {
    values_[0] = low;
    values_[1] = high;
  }
};

class EveryViewActuator : public ActuatorsOf<ValueActuator, EveryViewLevels>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 2);
    MakeDevices();
  }
  void Commit(const ChannelView&, AttributeChanges&) override {}
};

PluginDescription EveryViewDescription()
{
  return {.label = "every_view", .implementation = "test_every_view", .brief = "is in every view"};
}

REGISTER_SENSOR(EveryViewSensor, EveryViewDescription())
REGISTER_ACTUATOR(EveryViewActuator, EveryViewDescription())
