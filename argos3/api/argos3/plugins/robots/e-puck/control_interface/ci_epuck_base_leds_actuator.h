// The eight red LEDs around an e-puck of argos3-epuck. They are numbered clockwise.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/logging/argos_log.h>

namespace argos
{

class CCI_EPuckBaseLEDsActuator : public CCI_Actuator
{
public:
  // Switches an LED, 0 to 7.
  virtual void SwitchLED(size_t led, bool on)
  {
    const UInt8 bit = static_cast<UInt8>(1U << led);
    m_unLEDSettings = static_cast<UInt8>(on ? m_unLEDSettings | bit : m_unLEDSettings & ~bit);
  }
  // Switches all LEDs.
  virtual void SwitchLEDs(bool on) { m_unLEDSettings = on ? 255 : 0; }

protected:
  UInt8 m_unLEDSettings = 0;
};

}  // namespace argos
