// The motion of the two wheels of a robot.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_DifferentialSteeringSensor : public CCI_Sensor
{
public:
  // Velocities are in cm/s, distances of the last tick in cm, and the axis length in cm.
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
