// The laser scanner on a Khepera IV: distances from 105 degrees to the right to 105 degrees to the left.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>

namespace argos
{

class CCI_KheperaIVLIDARSensor : public CCI_Sensor
{
public:
  // Returns a distance in cm from 2 cm before the body, 0 if nothing is in range. The first reading is the rightmost
  // one.
  virtual long GetReading(UInt32 beam) const = 0;
  virtual size_t GetNumReadings() const = 0;
  // Readings keep their values while power or laser are off. Both are on at first.
  virtual void PowerOn() = 0;
  virtual void PowerOff() = 0;
  virtual void LaserOn() = 0;
  virtual void LaserOff() = 0;
};

}  // namespace argos
