// CCI_PieCameraSensor: the view of the omnidirectional camera cut into equal sectors. For each sector and colour it has
// the nearest blob and the number of blobs. The type label is "pie_camera".
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/control_interface/ci_colour.h"
#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_PieCameraSensor : public CCI_SensorOf<CCI_PieCameraSensor>
{
public:
  static constexpr double NOTHING = std::numeric_limits<double>::infinity();
  struct Slice
  {
    double distance_m = NOTHING;  // distance of the nearest blob
    unsigned blobs = 0;
  };

  // Returns the number of sectors. Sector i spans the angles i .. i + 1 times 2 pi / GetNumSectors(), counter-clockwise
  // from the front.
  virtual unsigned GetNumSectors() const = 0;
  // Returns all sectors for one of the colours of CCI_Colour other than black; blobs of other colours count for the
  // nearest one. Throws std::invalid_argument for another colour. Valid until the next control step.
  virtual std::span<const Slice> GetAllSlices(std::uint32_t colour) const = 0;
  // Returns one sector. Throws std::out_of_range for a sector from GetNumSectors() on.
  const Slice& GetSlice(std::uint32_t colour, unsigned sector) const
  {
    if (sector >= GetNumSectors())
      throw std::out_of_range("sector " + std::to_string(sector) + " of " + std::to_string(GetNumSectors()));
    return GetAllSlices(colour)[sector];
  }

  static void Declare(Declaration& columns)
  {
    const std::pair<std::string, std::uint32_t> colours[] = {
        {"red", CCI_Colour::RED},       {"green", CCI_Colour::GREEN}, {"blue", CCI_Colour::BLUE},
        {"yellow", CCI_Colour::YELLOW}, {"cyan", CCI_Colour::CYAN},   {"magenta", CCI_Colour::MAGENTA},
        {"white", CCI_Colour::WHITE}};
    for (const auto& [name, colour] : colours)
      columns.AddEach([colour = colour](const CCI_PieCameraSensor& camera) { return camera.GetAllSlices(colour); },
                      CCI_Field({name + " # distance", "m", 0, NOTHING, true}, &Slice::distance_m),
                      CCI_Field({.name = name + " # blobs", .minimum = 0, .hides_zero = true}, &Slice::blobs));
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_PieCameraSensor;
