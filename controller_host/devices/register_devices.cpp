#include "common/plugin_descriptions/describe_builtins.h"
#include "controller_host/device.h"
#include "controller_host/devices/builtin_devices.h"

namespace swarmanoid
{

void RegisterBuiltinDevices()
{
  static const bool registered = []
  {
    DescribeBuiltinDevices();
    RegisterFootbotWheels();
    RegisterFootbotProximity();
    RegisterFootbotGripper();
    RegisterFootbotTurret();
    RegisterFootbotEncoders();
    RegisterFootbotAccelerometer();
    RegisterLight();
    RegisterLightRing();
    RegisterGround();
    RegisterProximity();
    RegisterWheels();
    RegisterLeds();
    RegisterPreferentialDirection();
    RegisterColourCameras();
    RegisterPieCamera();
    RegisterMotionSensors();
    RegisterMicrophones();
    RegisterDistanceScanners();
    RegisterDepthCameras();
    RegisterContact();
    RegisterTagReader();
    RegisterFunctionsChannel();
    RegisterRadioSender();
    RegisterRadioReceiver();
    RegisterRangeAndBearingSender();
    RegisterRangeAndBearingReceiver();
    RegisterEyebotPropellers();
    RegisterEyebotAttachment();
    RegisterEyebotAltitude();
    RegisterEyebotLaser();
    RegisterHandbotJoints();
    RegisterHandbotProximity();
    RegisterHandbotRope();
    PluginRegistry<SensorBatch>::Instance().RequireCode();
    PluginRegistry<ActuatorBatch>::Instance().RequireCode();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
