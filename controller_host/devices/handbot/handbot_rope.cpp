// The rope of the handbot: channel "handbot_rope": 1 while the rope is to be attached, winch speed in m/s of rope let
// out.
#include <algorithm>

#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Rope : public CommandsOf<CCI_HandBotRopeActuator>
{
public:
  using CommandsOf::CommandsOf;
  void Launch() override { values_[0] = 1; }
  void Release() override { values_[0] = 0; }
  void SetWinchVelocity(double velocity) override
  {
    values_[1] = std::clamp(velocity, -MAX_WINCH_SPEED, MAX_WINCH_SPEED);
  }
};

class RopeActuator : public ActuatorsOf<ChannelActuator, Rope>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 2);
    winch_noise_ = NoiseFrom(setup.parameters);
    MakeDevices();
  }
  void Commit(const ChannelView& channel, AttributeChanges& changes) override
  {
    ChannelActuator::Commit(channel, changes);
    if (!winch_noise_.IsActive()) return;
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      RandomStream random = streams_.Of(k);
      double& winch = channel.values[channel.offsets[k] + 1];
      const double noise = winch_noise_.Sample(random);
      if (winch != 0) winch += noise;
    }
  }

private:
  NoiseModel winch_noise_;
};

}  // namespace

const DeviceCode kHandbotRopeCode([] { BindActuator<RopeActuator>("handbot_rope", "dummy_handbot_rope"); });

}  // namespace swarmanoid
