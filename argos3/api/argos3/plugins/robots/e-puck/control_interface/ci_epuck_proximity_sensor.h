// The eight infrared sensors around an e-puck.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_EPuckProximitySensor : public CRingSensor
{
};

}  // namespace argos
