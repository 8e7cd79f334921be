// The header has the layout, the method and its sources. Unsigned datagrams are searched for the names of members,
// submessage by submessage, since a stranger must not speak in their name. Submessages that only address a member are
// allowed.
//
// Invariants: a salt is remembered only after a good signature with it, and strangers at most kMostStrangers at a time,
// so invented ones take no memory. signs_ is locked before checks_, if both are.
#include "common/bus/security/datagram_signatures.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cstring>

#include "common/bus/bus.h"
#include "common/bus/security/submessages.h"

namespace swarmanoid
{
namespace
{

constexpr char kKind = static_cast<char>(0x9d);  // a kind that RTPS leaves to vendors (DDSI-RTPS 2.2, 8.3.3.2.3)
constexpr char kLittleEndian = 1;
constexpr char kDataFragment = 0x16;
constexpr std::size_t kSaltAt = 4;  // in a signature
constexpr std::size_t kNumberAt = kSaltAt + kSaltBytes;
constexpr std::size_t kCodeAt = kNumberAt + sizeof(std::uint64_t);
constexpr std::size_t kPrefixAt = 8;  // in a datagram
constexpr std::size_t kHeaderBytes = kPrefixAt + sizeof(GuidPrefix);
constexpr unsigned char kOfDdsItself = 0xc0U;  // in the last byte of the id of a writer or reader
constexpr char kFirst[4] = {kKind, kLittleEndian, static_cast<char>(DatagramSignatures::kBytes - 4), 0};
// The process answers this announcement.
constexpr std::array<char, 4> kAnswered{0x0f, static_cast<char>(0x80), 24, 0};
// The submessage that Fast DDS appends to each datagram on the network, and fills in below our transport.
constexpr char kStatistics = static_cast<char>(0x80);
constexpr std::size_t kStatisticsBytes = 60;
constexpr char kStatisticsFirst[4] = {kStatistics, kLittleEndian, kStatisticsBytes - 4, 0};
constexpr const char* kPurpose = "swarmanoid datagram";

GuidPrefix PrefixAt(std::span<const char> bytes, std::size_t at)
{
  GuidPrefix prefix;
  std::memcpy(prefix.data(), bytes.data() + at, prefix.size());
  return prefix;
}

std::size_t StatisticsAtEnd(std::span<const char> datagram)
{
  if (datagram.size() < kHeaderBytes + kStatisticsBytes) return 0;
  const char* const end = datagram.data() + datagram.size();
  return std::memcmp(end - kStatisticsBytes, kStatisticsFirst, sizeof kStatisticsFirst) == 0 ? kStatisticsBytes : 0;
}

// `code`: the buffer for the new code, or the expected code.
bool Authenticate(EVP_CIPHER_CTX& cipher, std::uint64_t number, std::span<const char> bytes, char* code, bool makes)
{
  unsigned char nothing = 0;
  int count = 0;
  if (!StartMessage(cipher, number, bytes)) return false;
  const auto take = [&](int what)
  { return EVP_CIPHER_CTX_ctrl(&cipher, what, static_cast<int>(kCodeBytes), code) == 1; };
  const auto finish = [&] { return EVP_CipherFinal_ex(&cipher, &nothing, &count) == 1; };
  return makes ? finish() && take(EVP_CTRL_AEAD_GET_TAG) : take(EVP_CTRL_AEAD_SET_TAG) && finish();
}

}  // namespace

std::span<const char> DatagramSignatures::Sign(std::span<const char> datagram, std::vector<char>& room)
{
  const auto key = keys_->Own();
  if (!key || datagram.size() < kHeaderBytes) return datagram;
  const std::size_t size = datagram.size() - StatisticsAtEnd(datagram);
  room.resize(datagram.size() + kBytes);
  std::copy_n(datagram.begin(), size, room.begin());
  std::copy(datagram.begin() + static_cast<std::ptrdiff_t>(size), datagram.end(),
            room.begin() + static_cast<std::ptrdiff_t>(size + kBytes));
  char* const signature = room.data() + size;
  std::memcpy(signature, kFirst, sizeof kFirst);
  const std::lock_guard lock(signs_);
  if (key_ != key)
  {
    salt_ = NewSalt();
    signer_ = MakeCipher(*key, salt_, kPurpose, true);
    number_ = 0;
    key_ = key;
    const std::lock_guard also(checks_);
    members_.try_emplace(PrefixAt(datagram, kPrefixAt), Clock::now());
  }
  ++number_;
  std::memcpy(signature + kSaltAt, salt_.data(), salt_.size());
  std::memcpy(signature + kNumberAt, &number_, sizeof number_);
  if (!Authenticate(*signer_, number_, {room.data(), size + kCodeAt}, signature + kCodeAt, true))
    throw BusError("libcrypto cannot sign a datagram");
  return room;
}

DatagramSignatures::Checked DatagramSignatures::Check(std::span<const char> datagram)
{
  if (datagram.size() < kHeaderBytes) return {datagram};
  datagram = datagram.first(datagram.size() - StatisticsAtEnd(datagram));
  const std::lock_guard lock(checks_);
  if (IsSigned(datagram))
  {
    members_.try_emplace(PrefixAt(datagram, kPrefixAt), Clock::now());
    return {datagram};
  }
  return CheckUnsigned(datagram);
}

bool DatagramSignatures::IsSigned(std::span<const char>& datagram)
{
  if (datagram.size() < kHeaderBytes + kBytes) return false;
  const std::span<const char> whole = datagram;
  const std::span<const char> signature = whole.last(kBytes);
  if (std::memcmp(signature.data(), kFirst, sizeof kFirst) != 0) return false;
  datagram = whole.first(whole.size() - kBytes);
  Salt salt;
  std::uint64_t number = 0;
  std::array<char, kCodeBytes> code;
  std::memcpy(salt.data(), signature.data() + kSaltAt, salt.size());
  std::memcpy(&number, signature.data() + kNumberAt, sizeof number);
  std::memcpy(code.data(), signature.data() + kCodeAt, code.size());
  const auto is_good = [&](EVP_CIPHER_CTX& cipher)
  { return Authenticate(cipher, number, whole.first(whole.size() - kCodeBytes), code.data(), false); };
  if (const auto known = checkers_.find(salt); known != checkers_.end()) return is_good(*known->second);
  for (const RunKey& key : keys_->Known())
  {
    Cipher cipher = MakeCipher(key, salt, kPurpose, false);
    if (!is_good(*cipher)) continue;
    // Only good salts are stored, so invented ones take no memory.
    checkers_[salt] = std::move(cipher);
    return true;
  }
  return false;
}

DatagramSignatures::Checked DatagramSignatures::CheckUnsigned(std::span<const char> datagram)
{
  const GuidPrefix sender = PrefixAt(datagram, kPrefixAt);
  if (members_.count(sender) > 0) return Forged(sender);
  const bool has_key = keys_->Own().has_value();
  std::span<const char> rest = datagram.subspan(kHeaderBytes);
  while (rest.size() >= 4)
  {
    const std::span<const char> submessage = FirstSubmessage(rest);
    // Every process may address a member.
    if (submessage[0] != kInfoDestinationKind)
      if (const auto member = FindMember(submessage)) return Forged(*member);
    // A name could be split over fragments. No process needs fragments to describe itself.
    const bool is_cut = submessage[0] == kDataFragment && submessage.size() >= kWriterOfDataAt + 4 &&
                        (static_cast<unsigned char>(submessage[kWriterOfDataAt + 3]) & kOfDdsItself) == kOfDdsItself;
    if (is_cut && !members_.empty()) return Forged(members_.begin()->first);
    if (has_key && IsAnnouncement(submessage) && !MayAnnounce(sender)) return {.datagram = {}, .is_one_too_many = true};
    rest = rest.subspan(submessage.size());
  }
  return {.datagram = datagram, .is_of_stranger = has_key};
}

bool DatagramSignatures::MayAnnounce(const GuidPrefix& stranger)
{
  const Clock::time_point now = Clock::now();
  if (strangers_.count(stranger) == 0 && strangers_.size() >= kMostStrangers)
    std::erase_if(strangers_, [&](const auto& known) { return now - known.second >= absence_; });
  if (strangers_.count(stranger) == 0 && strangers_.size() >= kMostStrangers) return false;
  strangers_[stranger] = now;
  return true;
}

DatagramSignatures::Checked DatagramSignatures::Forged(const GuidPrefix& member) const
{
  const bool settles = Clock::now() - members_.at(member) < settling_;
  return settles ? Checked{} : Checked{{}, member};
}

std::optional<GuidPrefix> DatagramSignatures::FindMember(std::span<const char> submessage) const
{
  const bool announces = IsAnnouncement(submessage);
  for (const auto& [member, since] : members_)
    for (auto from = submessage.begin();;)
    {
      const auto found = std::search(from, submessage.end(), member.begin(), member.end());
      if (found == submessage.end()) break;
      const auto at = static_cast<std::size_t>(found - submessage.begin());
      const bool only_answers =
          announces && at >= kAnswered.size() && StandsAt(submessage, kAnswered, at - kAnswered.size());
      if (!only_answers) return member;
      from = found + 1;
    }
  return std::nullopt;
}

}  // namespace swarmanoid
