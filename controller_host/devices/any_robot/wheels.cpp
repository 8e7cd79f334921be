// The wheels of any robot whose kind has them. Specific: the channel "wheels" has the angular velocities [left, right]
// in rad/s, and the engine drives the body.
#include <algorithm>

#include "common/control_interface/ci_wheels_actuator.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/kind_of_batch.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Wheels : public CommandsOf<CCI_WheelsActuator>
{
public:
  Wheels(double* speeds, const WheelDrive& drive, double limit) : CommandsOf(speeds), drive_(drive), limit_(limit) {}
  double GetWheelRadius() const override { return drive_.radius_m; }
  double GetInterwheelDistance() const override { return drive_.axle_m; }
  void SetAngularVelocity(double left, double right) override
  {
    // NaN passes through, since the host reports it with the robot's name.
    values_[0] = std::clamp(left, -limit_, limit_);
    values_[1] = std::clamp(right, -limit_, limit_);
  }

private:
  const WheelDrive& drive_;
  double limit_;  // rad/s
};

class WheelsActuator : public ChannelActuator
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 2);
    noise_ = NoiseFrom(setup.parameters);
    const WheelDrive& drive = *KindOfBatch(setup).wheels;
    const double asked = setup.parameters.Number("max_speed");
    const double limit = (asked > 0 ? asked : drive.max_speed_m_s) / drive.radius_m;
    for (std::size_t k = 0; k < Robots(); ++k) wheels_.emplace_back(ValuesOf(k), drive, limit);
  }
  Wheels* Actuator(std::size_t k) override { return &wheels_[k]; }

private:
  std::vector<Wheels> wheels_;
};

}  // namespace

const DeviceCode kWheelsCode([] { BindActuator<WheelsActuator>("wheels", "generic_wheels"); });

}  // namespace swarmanoid
