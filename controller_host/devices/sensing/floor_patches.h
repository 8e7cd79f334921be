// The patches of the floor and the holes in it, for downward sensors and cameras. Patches cover each other in the order
// of the experiment file.
#pragma once

#include <memory>
#include <vector>

#include "common/math/pose.h"
#include "common/space/terrain/floor_picture.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct FloorPatch
{
  std::uint32_t entity;
  bool is_hole;
  bool is_disc;
  std::uint32_t colour_slot;
  double half_x, half_y;  // m; discs: radius in half_x
  double radius;          // m, of the circle around it
  Pose pose;              // set by the user of the patch
  std::shared_ptr<const FloorPicture> picture;

  // Returns true if a point in its frame is within the patch.
  bool Contains(double x, double y) const
  {
    if (is_disc) return x * x + y * y <= half_x * half_x;
    return __builtin_fabs(x) <= half_x && __builtin_fabs(y) <= half_y;
  }
  // Returns the colour at a point of the patch.
  std::uint32_t Colour(std::uint32_t tint, double x, double y) const
  {
    if (picture == nullptr) return tint;
    return Tinted(picture->ColourAt((x + half_x) / (2 * half_x), (y + half_y) / (2 * half_y)), tint);
  }
};

// Returns all of them, in the order of the file. Reads the pictures; throws ConfigurationError.
std::vector<FloorPatch> FloorPatchesOf(const CSwarmanoidSpace& space);

}  // namespace swarmanoid
