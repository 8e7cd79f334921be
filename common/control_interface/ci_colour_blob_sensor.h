// CCI_ColourBlobSensor: the base of the cameras of all robots. Connected pixels of one colour in a camera's image
// become one blob.
#pragma once

#include <cstdint>
#include <span>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

struct CCI_ColourBlob
{
  std::uint32_t colour = 0;  // 0xRRGGBB
  double distance_m = 0;     // in the plane of the robot's base; for cameras that look ahead along the line of sight
  double angle_rad = 0;      // counter-clockwise from the robot's front, -pi..pi
  double elevation_rad = 0;  // for cameras that look ahead, above the horizontal; 0 for cameras that see the floor
};

class CCI_ColourBlobSensor : public CCI_SensorOf<CCI_ColourBlobSensor>
{
public:
  // Returns all blobs in view, in no particular order, valid until the next control step.
  virtual std::span<const CCI_ColourBlob> GetAllBlobs() const = 0;

  // Returns the nearest blob whose hue is that of `colour` (CCI_Colour::Nearest), or nullptr if no blob has it.
  static const CCI_ColourBlob* FindNearest(std::span<const CCI_ColourBlob> blobs, std::uint32_t colour)
  {
    const CCI_ColourBlob* nearest = nullptr;
    for (const CCI_ColourBlob& blob : blobs)
      if (CCI_Colour::Nearest(blob.colour) == CCI_Colour::Nearest(colour) &&
          (nearest == nullptr || blob.distance_m < nearest->distance_m))
        nearest = &blob;
    return nearest;
  }
  const CCI_ColourBlob* GetNearestBlob(std::uint32_t colour) const { return FindNearest(GetAllBlobs(), colour); }

  static void Declare(Declaration& columns)
  {
    columns.AddRows(
        "blob", &CCI_ColourBlobSensor::GetAllBlobs,
        CCI_Field({"colour", "colour", 0, 0xffffff}, &CCI_ColourBlob::colour),
        CCI_Field({"distance", "m", 0}, &CCI_ColourBlob::distance_m),
        CCI_Field({"angle", "rad"}, &CCI_ColourBlob::angle_rad),
        CCI_Field({.name = "elevation", .unit = "rad", .hides_zero = true}, &CCI_ColourBlob::elevation_rad));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_ColourBlob;
using swarmanoid::CCI_ColourBlobSensor;
