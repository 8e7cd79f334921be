#include "common/program/colour.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

namespace swarmanoid
{

std::string Coloured(int file, Colour colour, std::string_view text)
{
  const char* refused = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool plain = isatty(file) == 0 || (refused != nullptr && *refused != '\0') ||
                     (terminal != nullptr && std::string_view(terminal) == "dumb");
  return plain ? std::string(text) : fmt::format("\033[{}m{}\033[0m", static_cast<int>(colour), text);
}

}  // namespace swarmanoid
