// The encoders of the real Khepera IV, for controllers that are also built for it. In simulation, here and in ARGoS3,
// the sensor is differential_steering.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_KheperaIVEncoderSensor : public CCI_Sensor
{
public:
  struct SReading
  {
    Real CoveredDistanceLeftWheel = 0;
    Real CoveredDistanceRightWheel = 0;
    Real WheelAxisLength = 0;
  };
  const SReading& GetReading() const { return m_sReading; }

protected:
  SReading m_sReading;
};

}  // namespace argos
