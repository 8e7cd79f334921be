// Wheel encoders of the footbot: how the wheels turned in the last tick, made from the metres that they rolled, which
// the engine sends on channel "footbot_encoders".
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

class EncodersSensor : public SensorsOf<ChannelSensor, ReadingsOf<CCI_FootBotEncodersSensor, 2>>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, 2);
    noise_ = NoiseFrom(setup.parameters);
    per_metre_ = 1 / (CCI_FootBotWheelsActuator::WHEEL_RADIUS_M * setup.space.GetTickSeconds());
    MakeDevices();
  }
  void Update(const ChannelView& channel) override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      for (std::size_t side = 0; side < 2; ++side)
        ValuesOf(k)[side] = channel.values[channel.offsets[k] + side] * per_metre_;
    AddNoise();
  }

private:
  double per_metre_ = 0;  // rad/s
};

}  // namespace

const DeviceCode kFootbotEncodersCode([]
                                      { BindSensor<EncodersSensor>("footbot_encoders", "engine_footbot_encoders"); });

}  // namespace swarmanoid
