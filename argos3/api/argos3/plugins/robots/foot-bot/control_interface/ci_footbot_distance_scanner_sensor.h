// Distances that the turning head of a foot-bot measured in the last tick, by its angle. They are in cm from the body;
// -1 means too near for the beam, -2 means nothing in range. Short beams reach to 26 cm, ahead and back of the head.
// Long beams reach from 12 to 142 cm, to its left and right.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_FootBotDistanceScannerSensor : public CCI_Sensor
{
public:
  using TReadingsMap = std::map<CRadians, Real>;
  const TReadingsMap& GetReadingsMap() const
  {
    Demand();
    return m_tReadingsMap;
  }
  const TReadingsMap& GetShortReadingsMap() const
  {
    Demand();
    return m_tShortReadingsMap;
  }
  const TReadingsMap& GetLongReadingsMap() const
  {
    Demand();
    return m_tLongReadingsMap;
  }

protected:
  TReadingsMap m_tReadingsMap;
  TReadingsMap m_tShortReadingsMap;
  TReadingsMap m_tLongReadingsMap;
};

}  // namespace argos
