// The altitude sensor of the eyebot: the way straight down to the first body of its own worlds, or to the floor.
// Generic.
#include <algorithm>
#include <memory>

#include "common/control_interface/eyebot/ci_eyebot_altitude_sensor.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class Altitude : public CCI_EyeBotAltitudeSensor
{
public:
  explicit Altitude(const double* altitude) : altitude_(altitude) {}
  double GetAltitude() const override { return *altitude_; }

private:
  const double* altitude_;
};

class AltitudeSensor : public SensorsOf<ValueSensor, Altitude>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 1);
    noise_ = NoiseFrom(setup.parameters);
    world_ = SensorWorld::Of(setup.space);
    MakeDevices();
  }

  // The sensor looks straight down, so it asks for no body beside the robot.
  double Reach() const override { return 0; }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      const std::uint32_t robot = robots_[k];
      const Vector3 from = space_->GetPose(robot).position;
      const Vector3 floor(from.x(), from.y(), 0);
      const auto is_below = [&](std::uint32_t body) { return body != robot && world_->CanHideFrom(robot, body); };
      *ValuesOf(k) = std::max(from.z(), 0.0) * std::min(world_->FirstHit(from, floor, is_below), 1.0);
    }
    AddNoise();
    for (double& altitude : values_) altitude = std::max(altitude, 0.0);
  }

private:
  std::shared_ptr<SensorWorld> world_;
};

}  // namespace

const DeviceCode kEyebotAltitudeCode([] { BindSensor<AltitudeSensor>("eyebot_altitude", "generic_eyebot_altitude"); });

}  // namespace swarmanoid
