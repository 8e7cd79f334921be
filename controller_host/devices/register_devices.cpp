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
    RegisterLeds();
    RegisterPreferentialDirection();
    RegisterEyebotPropellers();
    RegisterEyebotAttachment();
    RegisterEyebotLaser();
    RegisterHandbotJoints();
    RegisterHandbotRope();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
