#include "common/run/access/digest.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <vector>

#include "common/math/reproducible_math.h"
#include "common/run/access/bus_options.h"

namespace swarmanoid
{
namespace
{

// The functions of libcrypto. The library is loaded for the first digest: a run in one process makes none, and the load
// takes a millisecond.
struct Crypto
{
  decltype(&EVP_MD_CTX_new) make = nullptr;
  decltype(&EVP_MD_CTX_free) free = nullptr;
  decltype(&EVP_sha256) sha256 = nullptr;
  decltype(&EVP_DigestInit_ex) begin = nullptr;
  decltype(&EVP_DigestUpdate) add = nullptr;
  decltype(&EVP_DigestFinal_ex) end = nullptr;

  Crypto()
  {
    void* const library = OpenLibrary(SWARMANOID_LIBCRYPTO);
    if (library == nullptr) throw BusError(fmt::format("cannot load {}: {}", SWARMANOID_LIBCRYPTO, dlerror()));
    const auto find = [library]<class Function>(Function& function, const char* name)
    {
      function = reinterpret_cast<Function>(dlsym(library, name));
      if (function == nullptr) throw BusError(fmt::format("{} has no {}", SWARMANOID_LIBCRYPTO, name));
    };
    find(make, "EVP_MD_CTX_new");
    find(free, "EVP_MD_CTX_free");
    find(sha256, "EVP_sha256");
    find(begin, "EVP_DigestInit_ex");
    find(add, "EVP_DigestUpdate");
    find(end, "EVP_DigestFinal_ex");
  }
};

const Crypto& LoadedCrypto()
{
  static const Crypto crypto;
  return crypto;
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const { LoadedCrypto().free(context); }

Sha256::Sha256() : context_(LoadedCrypto().make())
{
  const Crypto& crypto = LoadedCrypto();
  if (context_ == nullptr || crypto.begin(context_.get(), crypto.sha256(), nullptr) != 1)
    throw BusError("libcrypto has no SHA-256");
}

Sha256::~Sha256() = default;

void Sha256::Add(std::span<const char> bytes) { LoadedCrypto().add(context_.get(), bytes.data(), bytes.size()); }

std::string Sha256::Text()
{
  std::array<unsigned char, 32> bytes{};
  LoadedCrypto().end(context_.get(), bytes.data(), nullptr);
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

std::string DigestOfFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  Sha256 digest;
  std::vector<char> block(1U << 16U);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())), file.gcount() > 0)
    digest.Add({block.data(), static_cast<std::size_t>(file.gcount())});
  return file.bad() ? std::string() : digest.Text();
}

}  // namespace swarmanoid
