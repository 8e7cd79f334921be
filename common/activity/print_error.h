// What a process says on its standard error, which may be a terminal. Text of scripts, exceptions, files and other
// processes may be in it, so that control characters are replaced: they could move the cursor or change the title. If
// the reader is gone, as after a connection by ssh has broken, the process goes on with what it has to tidy up:
// fmt::print would throw.
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
