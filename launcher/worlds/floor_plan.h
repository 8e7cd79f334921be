// Turns the picture of a floor plan into an experiment with walls, for `swarmanoid convert`.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/space/terrain/png_picture.h"

namespace swarmanoid
{

struct FloorPlanOptions
{
  double resolution_m = 0;  // the edge of a pixel
  double threshold = 0.5;   // pixels darker than this are walls: 0 black, 1 white
  double height_m = 0.5;    // of the walls
  std::string remark{};     // for the comment at the start
};

struct FloorPlan
{
  std::string experiment;  // its text
  int columns = 0;
  int rows = 0;
  std::size_t walls = 0;
};

// Returns whether a file is a picture, by its first bytes: PNG, JPEG or PGM.
bool IsPicture(std::string_view bytes);

// Returns the greys of a PNG, JPEG or PGM. Throws std::runtime_error, which names the file, if it cannot be read.
GreyPicture ReadPlanPicture(const std::string& path);
// Decodes a PGM, plain (P2) or binary (P5), of 8 or 16 bits. Throws std::runtime_error with the reason.
GreyPicture PgmPicture(std::string_view bytes);

// Covers the dark pixels with few boxes: the upper edge of the picture is at the largest y. `source`: the name of the
// picture, for the comment at the start. Throws std::runtime_error if there is no wall or there are too many.
FloorPlan PlanFromPicture(const GreyPicture& picture, const FloorPlanOptions& options, const std::string& source);

}  // namespace swarmanoid
