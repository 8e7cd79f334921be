// Suggests how the word that is being typed after `swarmanoid` may go on: commands, options and their values from the
// command line's own declaration, running experiments, plug-ins, values of --set. The shell scripts in
// launcher/completion ask for them by `swarmanoid --complete WORDS...`.
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

// Takes the words after `swarmanoid`; the last one, possibly empty, is being typed. Returns a line for each candidate
// that begins like it, with a tab and its meaning if it has one. The line ":files .xml" means files with that ending,
// and folders; ":files" means all files.
std::vector<std::string> Completions(const CLI::App& app, const std::vector<std::string>& words);

// Prints those of the sub-commands that are registered. Returns the exit code.
extern "C" int PrintCompletions(const std::vector<std::string>& words);

}  // namespace swarmanoid
