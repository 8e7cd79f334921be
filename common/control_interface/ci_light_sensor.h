// A ring of light sensors around the body, each of which tells how bright the lights are that it sees. Type label
// "light". Any robot can carry it.
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
