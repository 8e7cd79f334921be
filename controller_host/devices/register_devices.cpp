#include "controller_host/device.h"
#include "controller_host/devices/builtin_devices.h"

namespace swarmanoid
{

void RegisterBuiltinDevices()
{
  static const bool registered = []
  {
    RegisterFootbotWheels();
    RegisterFootbotProximity();
    RegisterFootbotGripper();
    RegisterFootbotTurret();
    RegisterFootbotEncoders();
    RegisterFootbotAccelerometer();
    RegisterFootbotLight();
    RegisterGround();
    RegisterProximity();
    RegisterWheels();
    RegisterLeds();
    RegisterPreferentialDirection();
    RegisterColourCameras();
    RegisterPieCamera();
    RegisterRangeAndBearingSender();
    RegisterRangeAndBearingReceiver();
    RegisterEyebotPropellers();
    RegisterEyebotAttachment();
    RegisterEyebotAltitude();
    RegisterEyebotLaser();
    RegisterHandbotJoints();
    RegisterHandbotRope();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
