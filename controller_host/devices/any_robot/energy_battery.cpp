// The charge of a battery that the parts of a robot draw from. The space server computes it, and it is in the state.
// Generic.
#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "common/control_interface/ci_battery_sensor.h"
#include "common/space/battery_slots.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class ChargeReadings : public CCI_BatterySensor
{
public:
  explicit ChargeReadings(const double* values) : values_(values) {}
  double GetCharge() const override { return values_[0]; }
  double GetTimeLeft() const override { return values_[1]; }

private:
  const double* values_;
};

class EnergyBattery : public SensorsOf<ValueSensor, ChargeReadings>
{
public:
  double Reach() const override { return 0; }
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 2);
    noise_ = NoiseFrom(setup.parameters);
    for (const std::uint32_t robot : robots_)
    {
      const std::optional<BatteryView> battery = BatteryView::Of(setup.space, robot);
      if (!battery) throw std::logic_error("the controller of a robot with an energy_battery does not list it");
      batteries_.push_back(*battery);
    }
    MakeDevices();
  }
  void Update(const ChannelView&) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      const double charge_j = batteries_[k].Charge_J(), power_w = batteries_[k].Power_W();
      const double noise = noise_.IsActive() ? noise_.Sample(streams_.Of(k)) : 0;
      ValuesOf(k)[0] = std::clamp(charge_j / batteries_[k].Model().capacity_j + noise, 0.0, 1.0);
      ValuesOf(k)[1] = power_w > 0 ? charge_j / power_w : std::numeric_limits<double>::infinity();
    }
  }

private:
  std::vector<BatteryView> batteries_;
};

}  // namespace

const DeviceCode kEnergyBatteryCode([] { BindSensor<EnergyBattery>("battery", kEnergyBattery); });

}  // namespace swarmanoid
