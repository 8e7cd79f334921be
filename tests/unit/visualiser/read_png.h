// Reads the pictures that renderers wrote.
#pragma once

#include <string>

#include "visualiser/scene/picture.h"

namespace swarmanoid
{

// Throws std::runtime_error, naming the file.
Picture ReadPng(const std::string& path);

}  // namespace swarmanoid
