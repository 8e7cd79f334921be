// Quotes words for a POSIX shell: for commands that are shown to be copied, and commands that another machine's shell
// runs.
#pragma once

#include <string>

namespace swarmanoid
{

// Returns the text as one word, in quotes unless it needs none.
std::string ShellWord(const std::string& text);

}  // namespace swarmanoid
