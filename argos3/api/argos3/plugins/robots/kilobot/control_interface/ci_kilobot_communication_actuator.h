// Sends messages of Kilobots.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/kilolib.h>

namespace argos
{

class CCI_KilobotCommunicationActuator : public CCI_Actuator
{
public:
  // Tries to send the message, once. Call it in each step until the sensor's MessageSent is true. Other robots that try
  // in the same step may be in the way.
  virtual void SetMessage(message_t* message) { m_ptMessage = message; }

protected:
  message_t* m_ptMessage = nullptr;
};

}  // namespace argos
