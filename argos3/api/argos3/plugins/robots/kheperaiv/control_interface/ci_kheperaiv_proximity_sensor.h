// The eight infrared sensors around a Khepera IV, counter-clockwise from the front. A reading is 1 up to 4 cm from the
// sensor, and 4.14 exp(-33 d) - 0.085 at d m up to 12 cm.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_KheperaIVProximitySensor : public CRingSensor
{
};

}  // namespace argos
