#include "controller_host/device.h"
#include "controller_host/devices/footbot_proximity.h"
#include "controller_host/devices/footbot_wheels.h"

namespace swarmanoid
{

void RegisterBuiltinDevices()
{
  static const bool registered = []
  {
    RegisterFootbotProximity();
    RegisterFootbotWheels();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
