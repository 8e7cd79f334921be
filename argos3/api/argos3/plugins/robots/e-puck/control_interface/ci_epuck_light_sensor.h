// The eight light sensors around an e-puck of argos3-epuck.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_EPuckLightSensor : public CRingSensor
{
public:
  // Throws std::out_of_range for a sensor that does not exist.
  const SReading& GetReading(UInt16 sensor) const { return GetReadings().at(sensor); }
};

}  // namespace argos
