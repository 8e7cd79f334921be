// Writes manual pages from the options that a program declares: `PROGRAM --man-pages FOLDER`. Used when Swarmanoid is
// installed.
#pragma once

#include <string>

namespace CLI
{
class App;
}

namespace swarmanoid
{

inline constexpr const char* kManPagesFlag = "--man-pages";

// Writes PROGRAM.1, and PROGRAM-COMMAND.1 for each of its commands, in troff, into an existing folder. Throws
// std::runtime_error.
void WriteManPages(const CLI::App& program, const std::string& folder);

}  // namespace swarmanoid
