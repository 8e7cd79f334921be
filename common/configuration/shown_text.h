// Text from other processes, files or plug-ins that is shown to people, in logs and on terminals.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace swarmanoid
{

inline constexpr std::size_t kLongestName = 1024;       // bytes of ids and names of processes in a message
inline constexpr std::size_t kLongestText = 64 * 1024;  // bytes of a text for people in a message

// Returns whether the text is well-formed UTF-8 without control characters other than line feed and tab. Then it cannot
// move the cursor or change the title.
bool IsShowable(std::string_view text);
// Returns whether the text is showable and has neither line feed nor tab.
bool IsShowableLine(std::string_view text);
// Returns the text with a question mark for each byte that is not showable, cut to `most_bytes` between two characters.
std::string Showable(std::string_view text, std::size_t most_bytes = std::numeric_limits<std::size_t>::max());
// Returns the same as Showable, with a question mark for each line feed and tab, too.
std::string ShowableLine(std::string_view text, std::size_t most_bytes);

}  // namespace swarmanoid
