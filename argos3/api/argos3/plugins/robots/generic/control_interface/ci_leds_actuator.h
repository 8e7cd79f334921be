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
  // Sets the colour of an LED. Throws CARGoSException for an LED beyond the last one.
  virtual void SetSingleColor(UInt32 led, const CColor& colour);
  // Sets one colour for all LEDs.
  virtual void SetAllColors(const CColor& colour);
  // Sets a colour for each LED. Throws CARGoSException for a wrong number of colours.
  virtual void SetAllColors(const TSettings& colours);
  // Sets the intensity of an LED, 0 to 255. Throws CARGoSException for an LED beyond the last one.
  virtual void SetSingleIntensity(UInt32 led, UInt8 intensity);
  // Sets the intensity of all LEDs, 0 to 255.
  virtual void SetAllIntensities(UInt8 intensity);

protected:
  TSettings m_tSettings;
};

}  // namespace argos
