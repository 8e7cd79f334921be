// The LEDs of a robot. A foot-bot has 12 around the turret, and the beacon with number 12.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/datatypes/color.h>

namespace argos
{

class CCI_LEDsActuator : public CCI_Actuator
{
public:
  using TSettings = std::vector<CColor>;

  size_t GetNumLEDs() const { return m_tSettings.size(); }
  // Throw CARGoSException for an LED beyond the last one, and for a wrong number of colours.
  virtual void SetSingleColor(UInt32 led, const CColor& colour);
  virtual void SetAllColors(const CColor& colour);
  virtual void SetAllColors(const TSettings& colours);
  // `intensity`: 0 to 255.
  virtual void SetSingleIntensity(UInt32 led, UInt8 intensity);
  virtual void SetAllIntensities(UInt8 intensity);

protected:
  TSettings m_tSettings;
};

}  // namespace argos
