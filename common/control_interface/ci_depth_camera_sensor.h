// CCI_DepthCameraSensor: a camera with a small image. Each pixel has the distance and the colour of the visible
// surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_DepthCameraSensor : public CCI_SensorOf<CCI_DepthCameraSensor>
{
public:
  struct Pixel
  {
    // The depth is in m along the axis of the camera, not along the ray. It is infinity if nothing is in range (REP 118
    // of ROS).
    double depth_m = std::numeric_limits<double>::infinity();
    std::uint32_t colour = 0;  // 0xRRGGBB; 0 if nothing is in range
  };

  // Returns the width of the image in pixels.
  virtual unsigned GetWidth() const = 0;
  // Returns the height of the image in pixels.
  virtual unsigned GetHeight() const = 0;
  // Returns the angle (rad) between the left and the right border of the image. Pixels are square.
  virtual double GetFieldOfView() const = 0;
  // Returns the pixels row after row from the top, each row from the left: GetWidth() · GetHeight() pixels, valid until
  // the next control step.
  virtual std::span<const Pixel> GetAllPixels() const = 0;
  // Throws std::out_of_range for a pixel beyond the image.
  const Pixel& GetPixel(unsigned column, unsigned row) const
  {
    if (column >= GetWidth() || row >= GetHeight())
      throw std::out_of_range("pixel " + std::to_string(column) + ", " + std::to_string(row) + " of an image of " +
                              std::to_string(GetWidth()) + " by " + std::to_string(GetHeight()));
    return GetAllPixels()[static_cast<std::size_t>(row) * GetWidth() + column];
  }

  static void Declare(Declaration& columns)
  {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    constexpr auto kPrograms = CCI_Column::For::kPrograms, kPeople = CCI_Column::For::kPeople;
    columns
        .AddEach(&CCI_DepthCameraSensor::GetAllPixels,
                 CCI_Field({"depth #", "m", 0, kFar, true, false, kPrograms}, &Pixel::depth_m),
                 CCI_Field({"colour #", "colour", 0, 0xffffff, false, false, kPrograms}, &Pixel::colour))
        .Add({"depth in the middle", "m", 0, kFar, true, false, kPeople},
             [](const CCI_DepthCameraSensor& camera) { return camera.GetMiddle().depth_m; })
        .Add({"colour in the middle", "colour", 0, 0xffffff, false, false, kPeople},
             [](const CCI_DepthCameraSensor& camera) { return camera.GetMiddle().colour; })
        .Add({"nearest", "m", 0, kFar, true, false, kPeople}, &CCI_DepthCameraSensor::GetNearestDepth);
  }

private:
  const Pixel& GetMiddle() const { return GetPixel(GetWidth() / 2, GetHeight() / 2); }
  double GetNearestDepth() const
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Pixel& pixel : GetAllPixels()) nearest = std::min(nearest, pixel.depth_m);
    return nearest;
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_DepthCameraSensor;
