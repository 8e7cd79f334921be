// The points at which a robot's sensor reads the fields on the floor, as the experiment file writes them.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

inline constexpr std::size_t kMostFieldPoints = 64;

// Reads "x, y; x, y": metres in the frame of the robot. Returns nullopt for any other text, and for more than
// kMostFieldPoints points.
std::optional<std::vector<Vector2>> FieldPoints(std::string_view text);

}  // namespace swarmanoid
