// Accelerometer of the footbot, from the engine on channel "footbot_accelerometer": forward, left, up in m/s^2.
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
void RegisterFootbotAccelerometer()
{
  AddSensorPlugin<ChannelReadings<CCI_FootBotAccelerometerSensor, 3>>(
      {.label = "footbot_accelerometer",
       .implementation = "engine_footbot_accelerometer",
       .brief = "acceleration of the body, gravity included, in engines that know forces",
       .parameters = NoiseParameters("each component", "m/s^2"),
       .robots = {"footbot"},
       .channel = "footbot_accelerometer",
       .channel_width = 3});
}

}  // namespace swarmanoid
