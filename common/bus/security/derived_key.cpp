#include "common/bus/security/derived_key.h"

#include <openssl/core_names.h>
#include <openssl/evp.h>
#include <openssl/kdf.h>
#include <openssl/params.h>

#include <memory>

#include <fmt/format.h>

namespace swarmanoid
{

RunKey DerivedKey(const RunKey& key, std::span<const char> salt, const std::string& purpose)
{
  static EVP_KDF* const hkdf = EVP_KDF_fetch(nullptr, "HKDF", nullptr);
  const std::unique_ptr<EVP_KDF_CTX, decltype(&EVP_KDF_CTX_free)> context(
      hkdf == nullptr ? nullptr : EVP_KDF_CTX_new(hkdf), &EVP_KDF_CTX_free);
  char digest[] = "SHA256";
  // The parameters are only read.
  const auto bytes = [](const char* name, const void* data, std::size_t size)
  { return OSSL_PARAM_construct_octet_string(name, const_cast<void*>(data), size); };
  const OSSL_PARAM parameters[] = {
      OSSL_PARAM_construct_utf8_string(OSSL_KDF_PARAM_DIGEST, digest, 0),
      bytes(OSSL_KDF_PARAM_KEY, key.data(), key.size()), bytes(OSSL_KDF_PARAM_SALT, salt.data(), salt.size()),
      bytes(OSSL_KDF_PARAM_INFO, purpose.data(), purpose.size()), OSSL_PARAM_construct_end()};
  RunKey derived{};
  if (context == nullptr || EVP_KDF_derive(context.get(), derived.data(), derived.size(), parameters) != 1)
    throw BusError("libcrypto has no HKDF, by which the keys of messages are made");
  return derived;
}

GrantChannel ChannelOf(const RunKey& run_key, const AccessGrant& grant)
{
  if (grant.role == GrantRole::kOpenView) return {kOpenChannel, std::nullopt};
  const std::string purpose = fmt::format("swarmanoid share {} {} {}", grant.id, RoleWord(grant.role), grant.ends);
  return {grant.id, DerivedKey(run_key, grant.id, purpose)};
}

}  // namespace swarmanoid
