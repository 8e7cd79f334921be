// The options of a kind of visualiser after `swarmanoid attach` and `swarmanoid replay`: which there are depends on the
// kind, so they are known before the words are read.
#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace swarmanoid
{

// Adds the options of the kind that stands behind `verb` in the command of this process; a value given goes to
// `parameters` as "name=value". `position`: where the kind stands, from 0 behind the verb, if it is a library of a
// user.
void AddOptionsOfKind(CLI::App& verb, std::size_t position, std::vector<std::string>& parameters);

}  // namespace swarmanoid
