// Receives the bytes of all robots in range and sight.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/datatypes/byte_array.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/vector3.h>

namespace argos
{

class CCI_RangeAndBearingSensor : public CCI_Sensor
{
public:
  struct SPacket
  {
    Real Range = 0;  // cm
    CRadians HorizontalBearing;
    CRadians VerticalBearing;
    CByteArray Data;
  };
  using TReadings = std::vector<SPacket>;
  const TReadings& GetReadings() const
  {
    Demand();
    return m_tReadings;
  }

protected:
  TReadings m_tReadings;
};

}  // namespace argos
