// A camera that gives a small image: of each pixel how far away what it shows is, and its colour.
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

class CCI_DepthCameraSensor : public CCI_Sensor
{
public:
  struct Pixel
  {
    // m along the axis of the camera, not along the ray; infinity if nothing is in range (as ROS has it: REP 118).
    double depth_m = std::numeric_limits<double>::infinity();
    std::uint32_t colour = 0;  // 0xRRGGBB; 0 if nothing is in range
  };

  virtual unsigned GetWidth() const = 0;
  virtual unsigned GetHeight() const = 0;
  // rad, between the left and the right border of the image. Pixels are square.
  virtual double GetFieldOfView() const = 0;
  // Row after row from the top, each from the left: GetWidth() · GetHeight() pixels, valid until the next control step.
  virtual std::span<const Pixel> GetAllPixels() const = 0;
  // Beyond the image: std::out_of_range.
  const Pixel& GetPixel(unsigned column, unsigned row) const
  {
    if (column >= GetWidth() || row >= GetHeight())
      throw std::out_of_range("pixel " + std::to_string(column) + ", " + std::to_string(row) + " of an image of " +
                              std::to_string(GetWidth()) + " by " + std::to_string(GetHeight()));
    return GetAllPixels()[static_cast<std::size_t>(row) * GetWidth() + column];
  }

  // The middle of the image, and the nearest that is seen.
  std::vector<CCI_Column> Columns() const override
  {
    std::vector<CCI_Column> columns;
    for (std::size_t i = 0; i < std::size_t{GetWidth()} * GetHeight(); ++i)
    {
      columns.push_back({"depth " + std::to_string(i), "m", 0, std::numeric_limits<double>::infinity(), true});
      columns.push_back({"colour " + std::to_string(i), "colour", 0, 0xffffff});
    }
    return columns;
  }
  void ReadColumns(std::vector<double>& values) const override
  {
    for (const Pixel& pixel : GetAllPixels())
      values.insert(values.end(), {pixel.depth_m, static_cast<double>(pixel.colour)});
  }
  void Describe(std::vector<CCI_Reading>& readings) const override
  {
    const Pixel& middle = GetPixel(GetWidth() / 2, GetHeight() / 2);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Pixel& pixel : GetAllPixels()) nearest = std::min(nearest, pixel.depth_m);
    if (std::isfinite(middle.depth_m)) readings.push_back({"depth in the middle", "m", middle.depth_m});
    readings.push_back({"colour in the middle", "colour", static_cast<double>(middle.colour)});
    if (std::isfinite(nearest)) readings.push_back({"nearest", "m", nearest});
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_DepthCameraSensor;
