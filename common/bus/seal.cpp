#include "common/bus/seal.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <cstring>
#include <string>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kCodeBytes = 16;

// Threads of Fast DDS seal until the process has ended: libcrypto must not take itself down in an exit handler before.
[[maybe_unused]] const int kStaysUp = OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, nullptr);

using Code = std::array<unsigned char, EVP_MAX_MD_SIZE>;

// HMAC-SHA256 (RFC 2104) under a key of the topic and writer alone, which is made by HMAC from that of the run. Only
// the first half of the code is sent.
Code CodeOf(std::span<const char> bytes, const RunKey& key, std::string_view topic, const WriterId& writer)
{
  std::string purpose(topic);
  purpose.append(1, '\0').append(writer.data(), writer.size());
  Code own_key{};
  unsigned length = 0;
  HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), reinterpret_cast<const unsigned char*>(purpose.data()),
       purpose.size(), own_key.data(), &length);
  Code code{};
  HMAC(EVP_sha256(), own_key.data(), static_cast<int>(length), reinterpret_cast<const unsigned char*>(bytes.data()),
       bytes.size(), code.data(), &length);
  return code;
}

}  // namespace

void Seal(std::span<char> payload, const RunKey& key, std::string_view topic, const WriterId& writer,
          std::uint64_t number)
{
  const std::span<char> seal = payload.last(kSealBytes);
  std::memcpy(seal.data(), &number, sizeof number);
  const Code code = CodeOf(payload.first(payload.size() - kCodeBytes), key, topic, writer);
  std::memcpy(seal.data() + sizeof number, code.data(), kCodeBytes);
}

std::optional<std::uint64_t> NumberUnderSeal(std::span<const char> payload, const RunKey& key, std::string_view topic,
                                             const WriterId& writer)
{
  if (payload.size() < kSealBytes) return std::nullopt;
  const std::span<const char> seal = payload.last(kSealBytes);
  const Code code = CodeOf(payload.first(payload.size() - kCodeBytes), key, topic, writer);
  std::uint64_t number = 0;
  if (CRYPTO_memcmp(seal.data() + sizeof number, code.data(), kCodeBytes) != 0) return std::nullopt;
  std::memcpy(&number, seal.data(), sizeof number);
  return number;
}

}  // namespace swarmanoid
