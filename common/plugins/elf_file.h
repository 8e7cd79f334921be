// What can be known of a shared library without loading it: whether it is whole, and which build it is. Used before
// libraries are loaded (loading one that is cut short ends the program by a signal) and for checkpoints, in any
// process.
#pragma once

#include <string>

namespace swarmanoid
{

// Why the file cannot be a shared library for this machine, "it is cut short: …"; empty if it can.
std::string MistakeInLibrary(const std::string& path);

// The GNU build-id that the linker gave a library, or if it gave none, a digest (XXH3, 128 bits) of the file, as
// hexadecimal digits. Stripping and installing leave a build-id as it is. Throws FileError.
std::string BuildOfLibrary(const std::string& path);

}  // namespace swarmanoid
