// The certificate for access to web_render's page by TLS: one that the user gives, or a generated one. A generated one
// is kept, so that a browser that trusts it does so at the next run, too. Used when the server starts.
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
  std::string fingerprint;  // SHA-256 of the first certificate, "AB:CD:…", as browsers show it
};

// Reads a PEM file that has both; throws std::runtime_error.
Certificate GivenCertificate(const std::string& file);

// Returns a certificate for the names (host names, IP addresses), signed by its own key (ECDSA, P-256), valid for a
// year. The one in `file` is used if only the user can access it, it has all names, and it is valid for another month.
// Otherwise a new one is made and stored there if possible. An empty path stores nothing.
Certificate OwnCertificate(const std::filesystem::path& file, const std::vector<std::string>& names);

// Returns the names by which this machine is reached: localhost, its name, and the addresses of its interfaces.
std::vector<std::string> NamesOfThisMachine();

}  // namespace swarmanoid
