// The eight light sensors around a Khepera IV, counter-clockwise from the front.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_KheperaIVLightSensor : public CRingSensor
{
};

}  // namespace argos
