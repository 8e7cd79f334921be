// The options of a kind of visualiser after `swarmanoid attach` and `swarmanoid replay`. The kind determines the
// options, so it must be known before the words are parsed.
#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace swarmanoid
{

// Adds the options of the kind that follows `verb` in the command of this process. Given values are added to
// `parameters` as "name=value". `position`: the position of the kind after the verb, from 0, if it is a library of a
// user.
void AddOptionsOfKind(CLI::App& verb, std::size_t position, std::vector<std::string>& parameters);

}  // namespace swarmanoid
