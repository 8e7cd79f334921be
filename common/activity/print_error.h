// What a process says to whoever reads its standard error. If nobody does any more, as after a connection by ssh has
// broken, it goes on with what it has to tidy up: fmt::print would throw.
#pragma once

#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace swarmanoid
{

template <class... Arguments>
void PrintError(fmt::format_string<Arguments...> text, Arguments&&... arguments)
{
  std::fputs(fmt::format(text, std::forward<Arguments>(arguments)...).c_str(), stderr);
}

}  // namespace swarmanoid
