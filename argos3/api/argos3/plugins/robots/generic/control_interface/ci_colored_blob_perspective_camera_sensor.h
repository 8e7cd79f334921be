// Coloured blobs in the image of a camera.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/math/angles.h>

namespace argos
{

class CCI_ColoredBlobPerspectiveCameraSensor : public CCI_Sensor
{
public:
  struct SBlob
  {
    SBlob() = default;
    SBlob(const CColor& colour, SInt32 x, SInt32 y) : Color(colour), X(x), Y(y) {}

    CColor Color;
    // The position is in pixels of an image of 640 by 480, to the right and down from its upper left corner.
    SInt32 X = 0;
    SInt32 Y = 0;

    friend std::ostream& operator<<(std::ostream& stream, const SBlob& blob)
    {
      return stream << blob.Color << " at " << blob.X << "," << blob.Y;
    }
  };
  using TBlobList = std::vector<SBlob*>;
  struct SReadings
  {
    TBlobList BlobList;
    UInt64 Counter = 0;  // the number of the picture
  };
  const SReadings& GetReadings() const
  {
    Demand();
    return m_sReadings;
  }

protected:
  SReadings m_sReadings;
};

}  // namespace argos
