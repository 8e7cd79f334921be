// How the two wheels of a robot turned.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_DifferentialSteeringSensor : public CCI_Sensor
{
public:
  // cm/s, cm in the last tick, cm.
  struct SReading
  {
    Real VelocityLeftWheel = 0;
    Real VelocityRightWheel = 0;
    Real CoveredDistanceLeftWheel = 0;
    Real CoveredDistanceRightWheel = 0;
    Real WheelAxisLength = 0;
  };
  const SReading& GetReading() const { return m_sReading; }

protected:
  SReading m_sReading;
};

}  // namespace argos
