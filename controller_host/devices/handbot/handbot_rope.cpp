// The rope of the handbot: channel "handbot_rope": 1 while the rope is to be attached, winch speed in m/s of rope let
// out.
#include <algorithm>

#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Rope : public CCI_HandBotRopeActuator
{
public:
  explicit Rope(double* values) : values_(values) {}
  void Launch() override { values_[0] = 1; }
  void Release() override { values_[0] = 0; }
  void SetWinchVelocity(double velocity) override
  {
    values_[1] = std::clamp(velocity, -MAX_WINCH_SPEED, MAX_WINCH_SPEED);
  }

  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    readings.push_back({"launched", "yes/no", values_[0]});
    readings.push_back({"winch velocity", "m/s", values_[1]});
  }

private:
  double* values_;
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

void RegisterHandbotRope()
{
  AddActuatorPlugin<RopeActuator>({.label = "handbot_rope",
                                   .implementation = "dummy_handbot_rope",
                                   .brief = "shoots the rope to the ceiling and climbs by its winch",
                                   .parameters = NoiseParameters("the speed of the winch while it runs", "m/s"),
                                   .robots = {"handbot"},
                                   .channel = "handbot_rope",
                                   .channel_width = 2});
}

}  // namespace swarmanoid
