// Messages are sealed. Without the key of the run, no process can read, make or change one. It cannot send one as
// another writer or on another topic, or repeat one. The bus uses this, which does not depend on DDS.
//
// The method is AES-256-GCM (NIST SP 800-38D). Each writer draws a salt. Its key is derived from the run's key, the
// salt and the topic (HKDF-SHA256, RFC 5869). The nonce is the ascending number of the message. So no nonce is used
// twice under one key, even if one process replaces another.
//
//   encapsulation 4 | salt 12 | number 8 | encrypted: writer 16, fields of the message | code 16
#pragma once

#include <openssl/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/run/access/run_key.h"

namespace swarmanoid
{

inline constexpr std::size_t kSaltBytes = 12;
inline constexpr std::size_t kWriterBytes = 16;
inline constexpr std::size_t kCodeBytes = 16;
inline constexpr std::size_t kSealedFieldsAt = 4 + kSaltBytes + 8 + kWriterBytes;  // in a payload
// The zeros behind a payload's fields, and its sealed size. RTPS pads payloads to whole words, and the
// receiver must find the code at the end.
inline constexpr std::size_t kWordBytes = 4;
constexpr std::size_t PaddingOf(std::size_t payload_bytes)
{
  return (kWordBytes - payload_bytes % kWordBytes) % kWordBytes;
}
constexpr std::size_t SealedBytes(std::size_t payload_bytes)
{
  return payload_bytes + PaddingOf(payload_bytes) + kSealedFieldsAt - 4 + kCodeBytes;
}
// The largest growth of a payload when it is sealed.
inline constexpr std::size_t kMostSealBytes = SealedBytes(1) - 1;

// A writer is identified by its GUID in DDS.
using WriterId = std::array<char, kWriterBytes>;
using Salt = std::array<char, kSaltBytes>;

struct CipherFree
{
  void operator()(EVP_CIPHER_CTX* cipher) const;
};
using Cipher = std::unique_ptr<EVP_CIPHER_CTX, CipherFree>;

// Draws a random salt. Throws BusError if the system gives no random numbers.
Salt NewSalt();
// Returns AES-256-GCM with a key derived from the run's key, the salt and the purpose. Throws BusError.
Cipher MakeCipher(const RunKey& key, const Salt& salt, const std::string& purpose, bool encrypts);
// Starts the message of that number. `clear` is authenticated and not encrypted. Returns false if libcrypto fails.
bool StartMessage(EVP_CIPHER_CTX& cipher, std::uint64_t number, std::span<const char> clear);

// Seals the messages of one writer. One thread at a time may use it.
class Sealer
{
public:
  // Throws BusError if the system gives no random numbers, or libcrypto no cipher.
  Sealer(const RunKey& key, const std::string& topic);

  const RunKey& Key() const { return key_; }
  // Seals a message. `payload` has its fields at kSealedFieldsAt, and kCodeBytes of room behind them.
  void Seal(std::span<char> payload, const WriterId& writer);

private:
  RunKey key_;
  Salt salt_;
  Cipher cipher_;
  std::uint64_t number_ = 0;  // number of the last message
};

// Opens the messages of one reader. One thread at a time may use it.
class Opener
{
public:
  explicit Opener(std::string topic) : topic_(std::move(topic)) {}

  struct Opened
  {
    WriterId writer;  // the sealing writer
    Salt salt;
    std::uint64_t number = 0;
    std::span<const char> payload;  // the message without its seal
  };

  // Decrypts the payload into `room`. Returns nullopt if the writer is not known yet or the seal is not good. A writer
  // is known once OpenBy has opened one of its messages.
  std::optional<Opened> Open(std::span<const char> payload, std::vector<char>& room);
  bool Knows(std::span<const char> payload) const;
  // Does the same with a key that may be the right one.
  std::optional<Opened> OpenBy(const RunKey& key, std::span<const char> payload, std::vector<char>& room);

  // IsNew: whether the number is higher than all earlier ones of its writer and instance. Note records the number.
  bool IsNew(const Opened& opened, const std::string& instance = {}) const;
  void Note(const Opened& opened, const std::string& instance = {})
  {
    numbers_[{opened.salt, instance}] = opened.number;
  }

private:
  std::optional<Opened> Decrypt(EVP_CIPHER_CTX& cipher, std::span<const char> payload, std::vector<char>& room) const;

  const std::string topic_;
  std::map<Salt, Cipher> known_;
  std::map<std::pair<Salt, std::string>, std::uint64_t> numbers_;  // number of the last message
};

}  // namespace swarmanoid
