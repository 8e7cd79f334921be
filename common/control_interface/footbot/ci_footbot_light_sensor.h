// The 24 light sensors around the body of a footbot, at the angles of its proximity sensors.
#pragma once

#include "common/control_interface/ci_light_ring_sensor.h"

namespace swarmanoid
{

class CCI_FootBotLightSensor : public CCI_LightRingSensor
{
public:
  static constexpr double RING_HEIGHT_M = 0.06;  // above the base
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotLightSensor;
