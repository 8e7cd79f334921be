// The header has the layout, the method and its sources.
//
// Invariants: a pair of key and number seals one message at most; a message whose sealing fails is overwritten with
// zeros, never sent in the clear. Open returns a message only if its code fits. The caller takes it only if its number
// is above the last one of its salt and instance (IsNew).
#include "common/bus/security/seal.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <sys/random.h>

#include <cstring>
#include <utility>

#include "common/bus/bus.h"
#include "common/bus/security/derived_key.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kEncapsulationBytes = 4;
constexpr std::size_t kSealNumberAt = kEncapsulationBytes + kSaltBytes;
constexpr std::size_t kEncryptedAt = kSealNumberAt + sizeof(std::uint64_t);
constexpr std::size_t kNonceBytes = 12;

// Threads of Fast DDS seal messages until the process has ended, so libcrypto must not clean up in an exit handler.
[[maybe_unused]] const int kStaysUp = OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, nullptr);

unsigned char* Bytes(char* bytes) { return reinterpret_cast<unsigned char*>(bytes); }
const unsigned char* Bytes(const char* bytes) { return reinterpret_cast<const unsigned char*>(bytes); }

std::string PurposeOf(const std::string& topic) { return "swarmanoid message " + topic; }

// Starts with the encapsulation, salt and number at the front of `payload`.
bool StartPayload(EVP_CIPHER_CTX& cipher, const char* payload)
{
  std::uint64_t number = 0;
  std::memcpy(&number, payload + kSealNumberAt, sizeof number);
  return StartMessage(cipher, number, {payload, kEncryptedAt});
}

Salt SaltOf(std::span<const char> payload)
{
  Salt salt;
  std::memcpy(salt.data(), payload.data() + kEncapsulationBytes, salt.size());
  return salt;
}

bool CanBeSealed(std::span<const char> payload) { return payload.size() >= kSealedFieldsAt + kCodeBytes; }

}  // namespace

void CipherFree::operator()(EVP_CIPHER_CTX* cipher) const { EVP_CIPHER_CTX_free(cipher); }

Salt NewSalt()
{
  Salt salt;
  if (getrandom(salt.data(), salt.size(), 0) != static_cast<ssize_t>(salt.size()))
    throw BusError("the system gives no random numbers for the seals of messages");
  return salt;
}

Cipher MakeCipher(const RunKey& key, const Salt& salt, const std::string& purpose, bool encrypts)
{
  RunKey derived = DerivedKey(key, {salt.data(), salt.size()}, purpose);
  Cipher cipher(EVP_CIPHER_CTX_new());
  const bool good = cipher != nullptr && EVP_CipherInit_ex(cipher.get(), EVP_aes_256_gcm(), nullptr, derived.data(),
                                                           nullptr, encrypts ? 1 : 0) == 1;
  OPENSSL_cleanse(derived.data(), derived.size());
  if (!good) throw BusError("libcrypto has no AES-256-GCM, by which messages are sealed");
  return cipher;
}

bool StartMessage(EVP_CIPHER_CTX& cipher, std::uint64_t number, std::span<const char> clear)
{
  std::array<unsigned char, kNonceBytes> nonce{};
  std::memcpy(nonce.data() + 4, &number, sizeof number);
  int count = 0;
  return EVP_CipherInit_ex(&cipher, nullptr, nullptr, nullptr, nonce.data(), -1) == 1 &&
         EVP_CipherUpdate(&cipher, nullptr, &count, Bytes(clear.data()), static_cast<int>(clear.size())) == 1;
}

Sealer::Sealer(const RunKey& key, const std::string& topic)
    : key_(key), salt_(NewSalt()), cipher_(MakeCipher(key, salt_, PurposeOf(topic), true))
{
}

void Sealer::Seal(std::span<char> payload, const WriterId& writer)
{
  ++number_;
  std::memcpy(payload.data() + kEncapsulationBytes, salt_.data(), salt_.size());
  std::memcpy(payload.data() + kSealNumberAt, &number_, sizeof number_);
  std::memcpy(payload.data() + kEncryptedAt, writer.data(), writer.size());
  char* const secret = payload.data() + kEncryptedAt;
  const std::size_t size = payload.size() - kEncryptedAt - kCodeBytes;
  int count = 0;
  const bool good =
      StartPayload(*cipher_, payload.data()) &&
      EVP_CipherUpdate(cipher_.get(), Bytes(secret), &count, Bytes(secret), static_cast<int>(size)) == 1 &&
      EVP_CipherFinal_ex(cipher_.get(), Bytes(secret + size), &count) == 1 &&
      EVP_CIPHER_CTX_ctrl(cipher_.get(), EVP_CTRL_AEAD_GET_TAG, static_cast<int>(kCodeBytes), secret + size) == 1;
  // A message is never sent in the clear.
  if (!good) std::memset(secret, 0, size + kCodeBytes);
}

bool Opener::Knows(std::span<const char> payload) const
{
  return CanBeSealed(payload) && known_.count(SaltOf(payload)) > 0;
}

std::optional<Opener::Opened> Opener::Open(std::span<const char> payload, std::vector<char>& room)
{
  if (!CanBeSealed(payload)) return std::nullopt;
  const auto known = known_.find(SaltOf(payload));
  return known == known_.end() ? std::nullopt : Decrypt(*known->second, payload, room);
}

std::optional<Opener::Opened> Opener::OpenBy(const RunKey& key, std::span<const char> payload, std::vector<char>& room)
{
  if (!CanBeSealed(payload)) return std::nullopt;
  const Salt salt = SaltOf(payload);
  Cipher cipher = MakeCipher(key, salt, PurposeOf(topic_), false);
  auto opened = Decrypt(*cipher, payload, room);
  // Only good salts are stored, so invented ones take no memory.
  if (opened) known_[salt] = std::move(cipher);
  return opened;
}

std::optional<Opener::Opened> Opener::Decrypt(EVP_CIPHER_CTX& cipher, std::span<const char> payload,
                                              std::vector<char>& room) const
{
  const std::span<const char> secret = payload.subspan(kEncryptedAt, payload.size() - kEncryptedAt - kCodeBytes);
  std::array<char, kCodeBytes> code;
  std::memcpy(code.data(), payload.data() + payload.size() - kCodeBytes, kCodeBytes);
  if (room.size() < secret.size()) room.resize(secret.size());
  int count = 0;
  const bool good =
      StartPayload(cipher, payload.data()) &&
      EVP_CipherUpdate(&cipher, Bytes(room.data()), &count, Bytes(secret.data()), static_cast<int>(secret.size())) ==
          1 &&
      EVP_CIPHER_CTX_ctrl(&cipher, EVP_CTRL_AEAD_SET_TAG, static_cast<int>(kCodeBytes), code.data()) == 1 &&
      EVP_CipherFinal_ex(&cipher, Bytes(room.data() + secret.size()), &count) == 1;
  if (!good) return std::nullopt;
  Opened opened{{}, SaltOf(payload), 0, {}};
  std::memcpy(opened.writer.data(), room.data(), kWriterBytes);
  std::memcpy(&opened.number, payload.data() + kSealNumberAt, sizeof opened.number);
  char* const plain = room.data() + kWriterBytes - kEncapsulationBytes;
  std::memcpy(plain, payload.data(), kEncapsulationBytes);
  opened.payload = {plain, secret.size() - kWriterBytes + kEncapsulationBytes};
  return opened;
}

bool Opener::IsNew(const Opened& opened, const std::string& instance) const
{
  const auto last = numbers_.find({opened.salt, instance});
  return last == numbers_.end() || opened.number > last->second;
}

}  // namespace swarmanoid
