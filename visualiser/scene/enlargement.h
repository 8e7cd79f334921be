// Distant robots are drawn larger than they are, since robots of a pixel would not be seen. Pictures say so.
#pragma once

#include <string>

namespace swarmanoid
{

// Returns how many times larger a robot of a width (pixels) is drawn to have a least width, at most 8.
float Enlargement(float width, float least_width);

// Returns "robots up to 2.8 times as wide", or nothing if they are nearly as wide as they are.
std::string EnlargementText(float enlargement);

}  // namespace swarmanoid
