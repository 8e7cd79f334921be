// The LED of a Kilobot.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/datatypes/color.h>

namespace argos
{

class CCI_KilobotLEDActuator : public CCI_Actuator
{
public:
  // Sets the colour, which stays until the next one.
  virtual void SetColor(const CColor& color) { m_cColor = color; }

protected:
  CColor m_cColor;
};

}  // namespace argos
