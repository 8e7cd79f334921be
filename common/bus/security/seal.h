// Sealed messages: nobody without the key of the run can read them, make one, change one, say one as another writer or
// on another topic, or say one again. Used by the bus; knows nothing of DDS.
//
// AES-256-GCM (NIST SP 800-38D). Each writer draws a salt, from which and the topic its own key follows (HKDF-SHA256,
// RFC 5869); the number of the message, which ascends, is the nonce. So no nonce comes twice under one key, whatever
// process takes the place of another.
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

#include "common/bus/security/run_key.h"

namespace swarmanoid
{

inline constexpr std::size_t kSaltBytes = 12;
inline constexpr std::size_t kWriterBytes = 16;
inline constexpr std::size_t kCodeBytes = 16;
inline constexpr std::size_t kSealedFieldsAt = 4 + kSaltBytes + 8 + kWriterBytes;  // in a payload
// Of a payload that is sealed, and of the zeros behind its fields: RTPS lengthens payloads to whole words, and whoever
// opens it must find the code at the end.
inline constexpr std::size_t kWordBytes = 4;
constexpr std::size_t PaddingOf(std::size_t payload_bytes)
{
  return (kWordBytes - payload_bytes % kWordBytes) % kWordBytes;
}
constexpr std::size_t SealedBytes(std::size_t payload_bytes)
{
  return payload_bytes + PaddingOf(payload_bytes) + kSealedFieldsAt - 4 + kCodeBytes;
}
// By how many bytes at most a sealed payload is longer.
inline constexpr std::size_t kMostSealBytes = SealedBytes(1) - 1;

// Who writes: the GUID of a DDS writer.
using WriterId = std::array<char, kWriterBytes>;
using Salt = std::array<char, kSaltBytes>;

struct CipherFree
{
  void operator()(EVP_CIPHER_CTX* cipher) const;
};
using Cipher = std::unique_ptr<EVP_CIPHER_CTX, CipherFree>;

// Drawn at random. Throws BusError if the system gives no random numbers.
Salt NewSalt();
// AES-256-GCM with the key that follows from that of the run, the salt and the purpose. Throws BusError.
Cipher MakeCipher(const RunKey& key, const Salt& salt, const std::string& purpose, bool encrypts);
// For the message of that number, of which `clear` is authenticated and not encrypted. False if libcrypto fails.
bool StartMessage(EVP_CIPHER_CTX& cipher, std::uint64_t number, std::span<const char> clear);

// Of one writer. One thread at a time.
class Sealer
{
public:
  // Throws BusError if the system gives no random numbers, or libcrypto no cipher.
  Sealer(const RunKey& key, const std::string& topic);

  const RunKey& Key() const { return key_; }
  // `payload` has the fields of the message at kSealedFieldsAt, and kCodeBytes of room behind them.
  void Seal(std::span<char> payload, const WriterId& writer);

private:
  RunKey key_;
  Salt salt_;
  Cipher cipher_;
  std::uint64_t number_ = 0;  // of the last message
};

// Of one reader. One thread at a time.
class Opener
{
public:
  explicit Opener(std::string topic) : topic_(std::move(topic)) {}

  struct Opened
  {
    WriterId writer;  // who sealed it
    Salt salt;
    std::uint64_t number = 0;
    std::span<const char> payload;  // as if it had not been sealed
  };

  // What the payload holds, which is written into `room`; nullopt if it is of a writer that is not known yet, or nobody
  // sealed it. Writers that OpenBy met are known.
  std::optional<Opened> Open(std::span<const char> payload, std::vector<char>& room);
  bool Knows(std::span<const char> payload) const;
  // The same with a key that may be the right one.
  std::optional<Opened> OpenBy(const RunKey& key, std::span<const char> payload, std::vector<char>& room);

  // Whether its number is higher than those before it of its writer and instance; and that it is one of them now.
  bool IsNew(const Opened& opened, const std::string& instance = {}) const;
  void Note(const Opened& opened, const std::string& instance = {})
  {
    numbers_[{opened.salt, instance}] = opened.number;
  }

private:
  std::optional<Opened> Decrypt(EVP_CIPHER_CTX& cipher, std::span<const char> payload, std::vector<char>& room) const;

  const std::string topic_;
  std::map<Salt, Cipher> known_;
  std::map<std::pair<Salt, std::string>, std::uint64_t> numbers_;  // of the last message
};

}  // namespace swarmanoid
