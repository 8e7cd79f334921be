// The five ultrasound sensors of a Khepera IV: ahead, to the left at 45 and 90 degrees, to the right at 90 and 45
// degrees. A reading grows from 0 at 0.5 m from the body to 1 at 2.25 m. It is 0 if nothing is in range.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_KheperaIVUltrasoundSensor : public CRingSensor
{
};

}  // namespace argos
