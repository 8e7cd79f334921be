// CCI_LightSensor: a ring of light sensors around the body of any robot, each with the brightness of the lights that it
// sees. The type label is "light".
#pragma once

#include "common/control_interface/ci_ring_sensor.h"

namespace swarmanoid
{

// Readings are 0 (dark) to 1.
class CCI_LightSensor : public CCI_RingSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_LightSensor;
