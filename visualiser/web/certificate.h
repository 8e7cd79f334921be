// The certificate by which web_render's page is reached with TLS: one that the user gives, or one of its own, which is
// kept, so that a browser which was told to trust it once does so at the next run. Used when the server starts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swarmanoid
{

struct Certificate
{
  std::string chain;        // PEM
  std::string key;          // PEM
  std::string fingerprint;  // SHA-256 of the first one, "AB:CD:…", as browsers show it
};

// From a file that has both, PEM; throws std::runtime_error.
Certificate GivenCertificate(const std::string& file);

// For the names (host names, IP addresses); signed by its own key (ECDSA, P-256), valid for a year. The one in `file`,
// if it is the user's alone, names all of them and is valid for another month; otherwise a new one, which is kept there
// if that can be done. An empty path keeps nothing.
Certificate OwnCertificate(const std::filesystem::path& file, const std::vector<std::string>& names);

// By which this machine is reached: localhost, its name, and the addresses of its interfaces.
std::vector<std::string> NamesOfThisMachine();

}  // namespace swarmanoid
