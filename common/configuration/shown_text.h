// Text of other processes, scripts, files and users' code that people read, in logs and on terminals. Used by the bus
// and by all that prints.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace swarmanoid
{

// Whether it is well-formed UTF-8 without control characters other than line feed and tab: it can move no cursor and
// change no title.
bool IsShowable(std::string_view text);
// The text with a question mark for each byte that is not, cut to `most_bytes` between two characters.
std::string Showable(std::string_view text, std::size_t most_bytes = std::numeric_limits<std::size_t>::max());

}  // namespace swarmanoid
