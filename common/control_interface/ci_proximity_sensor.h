// CCI_ProximitySensor: the infrared proximity sensors of any robot whose kind has them. The type label is "proximity".
#pragma once

#include "common/control_interface/ci_ring_sensor.h"

namespace swarmanoid
{

// Readings are 0 (nothing in range) to 1 (touching).
class CCI_ProximitySensor : public CCI_RingSensor
{
};

}  // namespace swarmanoid

using swarmanoid::CCI_ProximitySensor;
