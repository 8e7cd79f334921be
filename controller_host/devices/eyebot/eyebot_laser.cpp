// The laser of the eyebot: switch, colour and direction as attributes; blob_sources.h computes the spot. Generic.
#include <algorithm>

#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/math/elementary.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Laser : public CommandsOf<CCI_EyeBotLaserActuator>
{
public:
  using CommandsOf::CommandsOf;
  void SwitchOn() override { values_[0] = 1; }
  void SwitchOff() override { values_[0] = 0; }
  void SetColour(std::uint32_t colour) override { values_[1] = colour & 0xffffff; }
  void SetDirection(double pan, double tilt) override
  {
    values_[2] = WrapAngle(pan);
    values_[3] = std::clamp(tilt, 0.0, MAX_TILT);
  }
};

class LaserActuator : public ActuatorsOf<AttributeActuator, Laser>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Bind(setup, {"laser", "laser_colour", "laser_pan", "laser_tilt"});
    direction_noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
  }
  void Commit(const ChannelView& channel, AttributeChanges& changes) override
  {
    if (!direction_noise_.IsActive()) return AttributeActuator::Commit(channel, changes);
    const std::vector<double> wanted = values_;
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      RandomStream random = streams_.Of(k);
      ValuesOf(k)[2] = WrapAngle(ValuesOf(k)[2] + direction_noise_.Sample(random));
      ValuesOf(k)[3] = std::clamp(ValuesOf(k)[3] + direction_noise_.Sample(random), 0.0, Laser::MAX_TILT);
    }
    AttributeActuator::Commit(channel, changes);
    std::copy(wanted.begin(), wanted.end(), values_.begin());
  }

private:
  NoiseModel direction_noise_;
};

}  // namespace

const DeviceCode kEyebotLaserCode([] { BindActuator<LaserActuator>("eyebot_laser", "generic_eyebot_laser"); });

}  // namespace swarmanoid
