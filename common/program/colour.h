// Colours of messages to people: only on terminals, and not if NO_COLOR is set (https://no-color.org).
#pragma once

#include <string>
#include <string_view>

namespace swarmanoid
{

enum class Colour
{
  kRed = 31,
  kGreen = 32,
  kYellow = 33
};

// Returns the text for a file descriptor, in that colour if it is a terminal.
std::string Coloured(int file, Colour colour, std::string_view text);

}  // namespace swarmanoid
