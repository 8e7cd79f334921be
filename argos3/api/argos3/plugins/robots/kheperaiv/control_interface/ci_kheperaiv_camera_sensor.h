// The camera of the real Khepera IV, for controllers that are also built for it. It is not simulated, here and in
// ARGoS3.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CCI_KheperaIVCameraSensor : public CCI_Sensor
{
public:
  struct SBlob
  {
    CColor Color;
    CVector2 Min;
    CVector2 Max;
    SBlob(const CColor& colour, const CVector2& place) : Color(colour), Min(place), Max(place) {}
  };
  using TBlobs = std::vector<SBlob>;
  UInt32 GetWidth() const { return m_unWidth; }
  UInt32 GetHeight() const { return m_unHeight; }
  // Returns the pixels, row by row.
  virtual const unsigned char* GetPixels() const = 0;
  const TBlobs& GetBlobs() const { return m_tBlobs; }

protected:
  UInt32 m_unWidth = 0;
  UInt32 m_unHeight = 0;
  TBlobs m_tBlobs;
};

}  // namespace argos
