// Prints to the standard error of a process, which may be a terminal. The text may come from scripts, exceptions, files
// or other processes, so control characters are replaced: they could move the cursor or change the title. If the reader
// is gone, for example after a broken ssh connection, the process continues and can tidy up; fmt::print would throw.
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "common/configuration/shown_text.h"

namespace swarmanoid
{

template <class... Arguments>
void PrintError(fmt::format_string<Arguments...> text, Arguments&&... arguments)
{
  std::fputs(Showable(fmt::format(text, std::forward<Arguments>(arguments)...)).c_str(), stderr);
}

}  // namespace swarmanoid
