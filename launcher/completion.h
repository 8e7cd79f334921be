// What a shell may offer for the word that is being typed after `swarmanoid`: commands, options and their values from
// the command line's own declaration, experiments that run here, plug-ins, values of --set. The scripts of the shells
// in launcher/completion ask for it by `swarmanoid --complete WORDS...`.
#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace swarmanoid
{

inline constexpr const char* kCompleteFlag = "--complete";

// The words after `swarmanoid`, of which the last, possibly empty, is being typed. A line for each candidate that
// begins like it, with a tab and its meaning if there is one. The line ":files .xml" stands for files with that ending,
// and folders; ":files" for all files.
std::vector<std::string> Completions(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace swarmanoid
