// The three sensors below an e-puck of argos3-epuck: 0 on black, 1 on white.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/configuration/argos_exception.h>

namespace argos
{

class CCI_EPuckGroundSensor : public CCI_Sensor
{
public:
  struct SReadings
  {
    Real Left = 0;
    Real Center = 0;
    Real Right = 0;
    void Reset() { Left = Center = Right = 0; }
    // Throw CARGoSException for other numbers than 0 (left), 1 and 2.
    Real& operator[](size_t sensor)
    {
      if (sensor > 2) THROW_ARGOSEXCEPTION("there is no ground sensor " << sensor << "; they are 0 to 2");
      return sensor == 0 ? Left : sensor == 1 ? Center : Right;
    }
    const Real& operator[](size_t sensor) const { return const_cast<SReadings&>(*this)[sensor]; }
  };
  const SReadings& GetReadings() const { return m_sReadings; }
  void GetReadings(Real* readings) const
  {
    for (size_t sensor = 0; sensor < 3; ++sensor) readings[sensor] = m_sReadings[sensor];
  }
  Real GetReading(size_t sensor) { return m_sReadings[sensor]; }

protected:
  SReadings m_sReadings;
};

}  // namespace argos
