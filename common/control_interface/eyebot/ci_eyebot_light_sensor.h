// The 24 light sensors around the body of an eyebot.
#pragma once

#include "common/control_interface/ci_light_ring_sensor.h"

namespace swarmanoid
{

class CCI_EyeBotLightSensor : public CCI_LightRingSensor
{
public:
  static constexpr double RING_HEIGHT_M = 0.1635;  // above the base
};

}  // namespace swarmanoid

using swarmanoid::CCI_EyeBotLightSensor;
