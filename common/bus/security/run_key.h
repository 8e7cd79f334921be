// The key of a run: whoever holds it belongs to the run. The launcher draws it and hands it to each process by its
// standard input; a space server that was started by hand draws its own. It lies in the folder of the run, which only
// its user can open, for those whom the same user starts later. Used by the bus, the launcher and tests.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

namespace swarmanoid
{

using RunKey = std::array<unsigned char, 32>;

// Throws BusError if the system gives no random numbers.
RunKey NewRunKey();

// As 64 hexadecimal digits, and back; nullopt for anything else. Blanks and line ends around them mean nothing.
std::string TextOfKey(const RunKey& key);
std::optional<RunKey> KeyOfText(const std::string& text);

// The key in a file that only this user can read, or that an open descriptor gives. If a descriptor is no file it is
// asked for on standard error, by kKeyPrompt, once a terminal shows it to nobody. Throws BusError.
RunKey KeyOfFile(const std::string& path);
RunKey KeyOfDescriptor(int descriptor);
inline constexpr const char* kKeyPrompt = "swarmanoid: give the key of the run";

// A key that follows from another one (HKDF-SHA256, RFC 5869), and does not tell that one. Throws BusError.
RunKey DerivedKey(const RunKey& key, std::span<const char> salt, const std::string& purpose);

// SHA-256 of a file, as 64 hexadecimal digits; empty if it cannot be read.
std::string DigestOfFile(const std::string& path);

}  // namespace swarmanoid
