// Reads the pictures of renderers.
#pragma once

#include <string>

#include "visualiser/scene/drawn_picture.h"

namespace swarmanoid
{

// Throws std::runtime_error, which names the file.
Picture ReadPng(const std::string& path);

}  // namespace swarmanoid
