// The omnidirectional camera of e-pucks of argos3-epuck: blobs of all lit LEDs that it sees. It is off until it is
// enabled.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_EPuckOmnidirectionalCameraSensor : public CCI_Sensor
{
public:
  struct SBlob
  {
    CColor Color = CColor::BLACK;
    CRadians Angle;     // from the front
    Real Distance = 0;  // cm
    UInt32 Area = 0;    // pixels
    friend std::ostream& operator<<(std::ostream& stream, const SBlob& blob)
    {
      return stream << "(Color = " << blob.Color << ",Angle = " << ToDegrees(blob.Angle)
                    << ",Distance = " << blob.Distance << ", Area = " << blob.Area << ")";
    }
  };
  using TBlobList = std::vector<SBlob*>;
  struct SReadings
  {
    TBlobList BlobList;
    UInt64 Counter = 0;
  };
  const SReadings& GetReadings() const { return m_sReadings; }
  bool Enabled() const { return IsEnabled(); }

protected:
  SReadings m_sReadings;
};

}  // namespace argos
