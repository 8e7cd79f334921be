// Words for a POSIX shell: commands that are shown to be copied, and those that another machine's shell runs.
#pragma once

#include <string>

namespace swarmanoid
{

// The text as one word, in quotes unless it needs none.
std::string ShellWord(const std::string& text);

}  // namespace swarmanoid
