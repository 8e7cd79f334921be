// Reads facts about a shared library without loading it: whether it is whole, and which build it is. Used before
// libraries are loaded, since loading one that is cut short ends the program by a signal. Used for checkpoints too, in
// any process.
#pragma once

#include <string>

namespace swarmanoid
{

// Returns why the file cannot be a shared library for this machine, such as "it is cut short: …"; empty if it can.
std::string MistakeInLibrary(const std::string& path);

// Returns the GNU build-id of a library as hexadecimal digits. Without a build-id it returns a digest (XXH3, 128 bits)
// of the file. Stripping and installing do not change a build-id. Throws FileError.
std::string BuildOfLibrary(const std::string& path);

}  // namespace swarmanoid
