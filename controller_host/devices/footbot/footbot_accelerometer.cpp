// Accelerometer of the footbot, from the engine on channel "footbot_accelerometer": forward, left, up in m/s^2.
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
void RegisterFootbotAccelerometer()
{
  PluginDescription description;
  description.label = "footbot_accelerometer";
  description.implementation = "engine_footbot_accelerometer";
  description.brief = "acceleration of the body, gravity included, in engines that know forces";
  description.robots = {"footbot"};
  description.channel = "footbot_accelerometer";
  description.channel_width = 3;
  description.parameters = NoiseParameters("each component", "m/s^2");
  AddSensorPlugin<ChannelReadings<CCI_FootBotAccelerometerSensor, 3>>(description);
}

}  // namespace swarmanoid
