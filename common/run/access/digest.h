// SHA-256 digests (FIPS 180-4) of files and texts: the libraries of a run, and the members of an archive.
#pragma once

#include <memory>
#include <span>
#include <string>

struct evp_md_ctx_st;

namespace swarmanoid
{

// The digest of bytes that come in parts.
class Sha256
{
public:
  // Loads libcrypto. Throws BusError if it is missing or has no SHA-256.
  Sha256();
  ~Sha256();
  void Add(std::span<const char> bytes);
  // Returns 64 hexadecimal digits. Nothing can be added afterwards.
  std::string Text();

private:
  struct Free
  {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

// Returns the digest of a file; empty if it cannot be read.
std::string DigestOfFile(const std::string& path);

}  // namespace swarmanoid
