// Receives messages of Kilobots.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/kilolib.h>

namespace argos
{

class CCI_KilobotCommunicationSensor : public CCI_Sensor
{
public:
  struct SPacket
  {
    const message_t* Message;
    distance_measurement_t Distance;
  };
  using TPackets = std::vector<SPacket>;
  const TPackets& GetPackets() const { return m_tPackets; }
  // Returns whether the own message was sent in this step.
  bool MessageSent() const { return m_bMessageSent; }

protected:
  TPackets m_tPackets;
  bool m_bMessageSent = false;
};

}  // namespace argos
