// The three coloured LEDs on top of an e-puck of argos3-epuck: front left, front right and back.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/logging/argos_log.h>

namespace argos
{

class CCI_EPuckRGBLEDsActuator : public CCI_Actuator
{
public:
  using TLEDSettings = std::vector<CColor>;
  CCI_EPuckRGBLEDsActuator() : m_tLEDSettings(3, CColor::BLACK) {}
  // Throw std::out_of_range for an LED that does not exist, or fewer than three colours.
  virtual void SetColor(size_t led, const CColor& color) { m_tLEDSettings.at(led) = color; }
  virtual void SetColors(const CColor& color) { m_tLEDSettings.assign(3, color); }
  virtual void SetColors(const TLEDSettings& colors)
  {
    for (size_t led = 0; led < 3; ++led) SetColor(led, colors.at(led));
  }

protected:
  TLEDSettings m_tLEDSettings;
};

}  // namespace argos
