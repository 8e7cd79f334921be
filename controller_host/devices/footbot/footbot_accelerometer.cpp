// Accelerometer of the footbot, from the engine on channel "footbot_accelerometer": forward, left, up in m/s^2.
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
const DeviceCode kFootbotAccelerometerCode(
    []
    {
      BindSensor<ChannelReadings<CCI_FootBotAccelerometerSensor, 3>>("footbot_accelerometer",
                                                                     "engine_footbot_accelerometer");
    });

}  // namespace swarmanoid
