// Receives messages of e-pucks of argos3-epuck.
#pragma once

#include <iostream>

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_EPuckRangeAndBearingSensor : public CCI_Sensor
{
public:
  static const UInt32 MAX_BYTES_RECEIVED = 4;
  using TData = UInt8[MAX_BYTES_RECEIVED];
  struct SReceivedPacket
  {
    Real Range = 0;    // cm, between the bodies
    CRadians Bearing;  // of the sender
    TData Data = {0, 0, 0, 0};
  };
  using TPackets = std::vector<SReceivedPacket*>;
  const TPackets& GetPackets() const { return m_tPackets; }
  void ClearPackets() { m_tPackets.clear(); }

protected:
  TPackets m_tPackets;
};

inline std::ostream& operator<<(std::ostream& stream, const CCI_EPuckRangeAndBearingSensor::SReceivedPacket& packet)
{
  stream << "Received range < " << packet.Range << " > Bearing < " << packet.Bearing << " > Data <";
  for (UInt8 byte : packet.Data) stream << " " << +byte;
  return stream << " >";
}

}  // namespace argos
