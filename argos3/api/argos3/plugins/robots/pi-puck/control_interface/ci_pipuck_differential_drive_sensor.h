// The speeds of a Pi-Puck's wheels, as they were commanded.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_PiPuckDifferentialDriveSensor : public CCI_Sensor
{
public:
  // Return the speed of a wheel on the ground, m/s.
  virtual Real GetLeftVelocity() = 0;
  virtual Real GetRightVelocity() = 0;
};

}  // namespace argos
