// The key of a run. Every process with the key belongs to the run. The launcher draws it and passes it to each process
// on standard input. A space server that was started by hand draws its own. Processes that the same user starts later
// find it in the folder of the run, which only that user can open. The bus, the launcher and tests use it.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace swarmanoid
{

using RunKey = std::array<unsigned char, 32>;

// Draws a new key. Throws BusError if the system gives no random numbers.
RunKey NewRunKey();

// Converts to 64 hexadecimal digits, and back; nullopt for anything else. Blanks and line ends around them are ignored.
std::string TextOfKey(const RunKey& key);
std::optional<RunKey> KeyOfText(const std::string& text);

// Reads the key from a file that only this user can read, or from an open descriptor. If the descriptor is no file, it
// prints kKeyPrompt on standard error, once the terminal does not echo. Throws BusError.
RunKey KeyOfFile(const std::string& path);
RunKey KeyOfDescriptor(int descriptor);
inline constexpr const char* kKeyPrompt = "swarmanoid: give the key of the run";

}  // namespace swarmanoid
