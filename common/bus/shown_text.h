// Text that other processes send and people read, in logs and on terminals. Used by the bus.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swarmanoid
{

// Whether it is well-formed UTF-8 without control characters other than line feed and tab: it can move no cursor and
// change no title.
bool IsShowable(std::string_view text);
// The text with a question mark for each byte that is not, cut to `most_bytes` between two characters.
std::string Showable(std::string_view text, std::size_t most_bytes);

}  // namespace swarmanoid
