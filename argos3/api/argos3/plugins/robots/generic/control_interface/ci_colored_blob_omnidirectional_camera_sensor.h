// Coloured blobs around a robot.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CCI_ColoredBlobOmnidirectionalCameraSensor : public CCI_Sensor
{
public:
  struct SBlob
  {
    CColor Color;
    CRadians Angle;
    Real Distance = 0;  // cm
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
