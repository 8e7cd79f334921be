#include "common/bus/dds/check_rtps.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace swarmanoid
{
// Several sources of a library are compiled as one, and others have names of RTPS, too.
namespace rtps_structure
{
namespace
{

// The reason for a refusal, or nullptr if there is no defect.
using Reason = const char*;

constexpr std::size_t kHeaderBytes = 20;
constexpr char kProtocolMajor = 2;
constexpr std::array<char, 2> kVendorOfFastDds{0x01, 0x0f};

enum Kind : std::uint8_t
{
  kPad = 0x01,
  kAckNack = 0x06,
  kHeartbeat = 0x07,
  kGap = 0x08,
  kInfoTimestamp = 0x09,
  kInfoSource = 0x0c,
  kInfoReplyIp4 = 0x0d,
  kInfoDestination = 0x0e,
  kInfoReply = 0x0f,
  kNackFragment = 0x12,
  kHeartbeatFragment = 0x13,
  kData = 0x15,
  kDataFragment = 0x16,
  kFirstOfSecurity = 0x30,
  kLastOfSecurity = 0x34,
  kStatistics = 0x80,
};

constexpr unsigned kLittleEndianFlag = 0x01;
constexpr unsigned kInlineQosFlag = 0x02;      // in DATA and DATA_FRAG
constexpr unsigned kDataFlag = 0x04;           // in DATA
constexpr unsigned kKeyFlag = 0x08;            // in DATA
constexpr unsigned kKeyOfFragmentFlag = 0x04;  // in DATA_FRAG
constexpr unsigned kInvalidateFlag = 0x02;     // in INFO_TS
constexpr unsigned kMulticastFlag = 0x02;      // in INFO_REPLY

constexpr std::size_t kStatisticsBytes = 56;     // behind the header of the submessage
constexpr std::size_t kDataFixedBytes = 20;      // in front of the inline quality of service
constexpr std::size_t kFragmentFixedBytes = 32;  // the same for DATA_FRAG
constexpr std::size_t kEncapsulationBytes = 4;   // in front of a payload
constexpr std::size_t kLivelinessBytes = 24;     // the smallest payload of the writer of liveliness
constexpr std::size_t kLocatorBytes = 24;
constexpr std::uint32_t kMostBits = 256;  // size limit of a number set (DDSI-RTPS 2.2, 9.4.2.6)
constexpr std::int64_t kLastNumber = std::int64_t{1}
                                     << 60;  // Fast DDS adds 256 to numbers, and asserts a sum below 2^63
// A reader of Fast DDS marks the messages of a GAP one by one: 10,000 take a millisecond. Members send GAPs for what a
// history no longer has, and histories have 64 messages at most.
constexpr std::int64_t kLongestGap = 10'000;
// Fast DDS keeps the numbers of missing fragments at the beginning of each fragment. They fit into fragments that are
// as large as this, and do not overlap if sizes are multiples of 4. Datagrams of 1,024 bytes, the smallest that a run
// may use, have fragments of 800.
constexpr std::uint32_t kLeastFragment = 256;
// Fast DDS reads descriptions of types by recursion. One of this size cannot use up the stack. Types here have none.
constexpr std::size_t kMostTypeBytes = 4096;

// Access to bytes in the byte order of their submessage. The caller must check size() before it reads.
struct Bytes
{
  std::span<const char> bytes;
  bool is_little_endian = true;

  std::size_t size() const { return bytes.size(); }
  std::uint8_t Byte(std::size_t at) const { return static_cast<std::uint8_t>(bytes[at]); }
  std::uint16_t Short(std::size_t at) const
  {
    const unsigned low = Byte(at + (is_little_endian ? 0 : 1));
    const unsigned high = Byte(at + (is_little_endian ? 1 : 0));
    return static_cast<std::uint16_t>(low | (high << 8U));
  }
  std::uint32_t Word(std::size_t at) const
  {
    const std::uint32_t first = Short(at);
    const std::uint32_t second = Short(at + 2);
    return is_little_endian ? first | (second << 16U) : second | (first << 16U);
  }
  // The high half of a sequence number comes first in both orders.
  std::int64_t Number(std::size_t at) const
  {
    return static_cast<std::int64_t>((std::uint64_t{Word(at)} << 32U) | Word(at + 4));
  }
  Bytes From(std::size_t at) const { return {bytes.subspan(at), is_little_endian}; }
  Bytes Part(std::size_t at, std::size_t count) const { return {bytes.subspan(at, count), is_little_endian}; }
};

constexpr std::size_t RoundUp(std::size_t size) { return (size + 3) & ~std::size_t{3}; }

bool IsAmong(std::int64_t number, std::int64_t first, std::int64_t last) { return number >= first && number <= last; }

// --- sets of numbers ---------------------------------------------------------------------------------------------

// Checks a bitmap. `bits_at` is the position of the number of bits, after the base. The words of the bitmap and
// `count`, four bytes, follow.
Reason CheckBitmap(const Bytes& body, std::size_t bits_at, std::size_t count)
{
  if (body.size() < bits_at + 4) return "a set of numbers that ends before its count";
  const std::uint32_t bits = body.Word(bits_at);
  if (bits > kMostBits) return "a set of more than 256 numbers";
  if (body.size() < bits_at + 4 + ((bits + 31) / 32) * 4 + count) return "a set of numbers that ends before its bits";
  return nullptr;
}

Reason CheckAckNack(const Bytes& body)
{
  if (body.size() < 20) return "an ACKNACK that is too short";
  if (const Reason reason = CheckBitmap(body, 16, 4)) return reason;
  // Fast DDS asks for everything by the base 0, without numbers.
  const std::int64_t base = body.Number(8);
  if (!IsAmong(base, body.Word(16) == 0 ? 0 : 1, kLastNumber)) return "an ACKNACK of a number that does not exist";
  return nullptr;
}

Reason CheckGap(const Bytes& body, const RtpsLimits& limits)
{
  if (body.size() < 28) return "a GAP that is too short";
  if (const Reason reason = CheckBitmap(body, 24, 0)) return reason;
  const std::int64_t start = body.Number(8);
  const std::int64_t end = body.Number(16);
  // Fast DDS subtracts 1 from the end, and asserts that this is no overflow.
  if (!IsAmong(start, 1, kLastNumber) || !IsAmong(end, start, kLastNumber)) return "a GAP of numbers that do not exist";
  if (end - start > kLongestGap) return "a GAP of more than 10,000 messages";
  if (end + kMostBits > limits.gap_end) return "a GAP of numbers that its sender cannot have";
  return nullptr;
}

Reason CheckHeartbeat(const Bytes& body, const RtpsLimits& limits)
{
  if (body.size() < 28) return "a HEARTBEAT that is too short";
  const std::int64_t first = body.Number(8);
  const std::int64_t last = body.Number(16);
  // Without messages, the last number is the one before the first.
  if (!IsAmong(first, 1, kLastNumber) || !IsAmong(last, first - 1, kLastNumber))
    return "a HEARTBEAT of numbers that do not exist";
  if (first > limits.heartbeat_first) return "a HEARTBEAT of numbers that its sender cannot have";
  return nullptr;
}

Reason CheckNackFragment(const Bytes& body)
{
  if (body.size() < 24) return "a NACK_FRAG that is too short";
  if (const Reason reason = CheckBitmap(body, 20, 4)) return reason;
  if (!IsAmong(body.Number(8), 1, kLastNumber)) return "a NACK_FRAG of a message that does not exist";
  // A writer of Fast DDS sends fragment 0 from 4 GiB behind its message.
  const std::uint32_t base = body.Word(16);
  if (base < 1 || base > kMemberLimits.sample_bytes) return "a NACK_FRAG of fragments that do not exist";
  return nullptr;
}

Reason CheckHeartbeatFragment(const Bytes& body)
{
  if (body.size() < 24) return "a HEARTBEAT_FRAG that is too short";
  if (!IsAmong(body.Number(8), 1, kLastNumber) || body.Word(16) < 1)
    return "a HEARTBEAT_FRAG of a message that does not exist";
  return nullptr;
}

// --- lists of parameters -------------------------------------------------------------------------------------------

// Removes a string of CDR from the front: four bytes of length, then text with its zero, rounded up. Returns false if
// the bytes hold no whole string.
bool TakeString(Bytes& from)
{
  if (from.size() < 4) return false;
  const std::size_t length = from.Word(0);
  if (length < 1 || length > from.size() - 4 || from.Byte(4 + length - 1) != 0) return false;
  from = from.From(std::min(from.size(), 4 + RoundUp(length)));
  return true;
}

// Removes a count, and as many items of `each` strings.
bool HasStrings(const Bytes& parameter, unsigned each)
{
  if (parameter.size() < 4) return false;
  Bytes rest = parameter.From(4);
  for (std::uint32_t left = parameter.Word(0); left > 0; --left)
    for (unsigned k = 0; k < each; ++k)
      if (!TakeString(rest)) return false;
  return true;
}

// Returns whether a count is followed by as many items of that size.
bool HasItems(const Bytes& parameter, std::size_t bytes)
{
  return parameter.size() >= 4 && parameter.Word(0) <= (parameter.size() - 4) / bytes;
}

bool IsContentFilter(const Bytes& parameter)
{
  Bytes rest = parameter;
  for (int k = 0; k < 4; ++k)
    if (!TakeString(rest)) return false;
  return HasStrings(rest, 1);
}

enum ParameterId : std::uint16_t
{
  kSentinel = 0x0001,
  kLease = 0x0002,
  kTopicName = 0x0005,
  kTypeName = 0x0007,
  kProtocolVersion = 0x0015,
  kVendorId = 0x0016,
  kPartition = 0x0029,
  kUserData = 0x002c,
  kGroupData = 0x002d,
  kTopicData = 0x002e,
  kUnicastLocator = 0x002f,
  kMulticastLocator = 0x0030,
  kDefaultUnicastLocator = 0x0031,
  kMetatrafficUnicastLocator = 0x0032,
  kMetatrafficMulticastLocator = 0x0033,
  kContentFilter = 0x0035,
  kDefaultMulticastLocator = 0x0048,
  kParticipantGuid = 0x0050,
  kPropertyList = 0x0059,
  kEndpointGuid = 0x005a,
  kEntityName = 0x0062,
  kTypeIdV1 = 0x0069,
  kKeyHash = 0x0070,
  kStatusInfo = 0x0071,
  kTypeObjectV1 = 0x0072,
  kDataRepresentation = 0x0073,
  kTypeInformation = 0x0075,
  kFirstSecurityParameter = 0x1001,
  kLastSecurityParameter = 0x1006,
  kPersistenceGuid = 0x8002,
  kDataSharing = 0x8006,
  kRelatedSampleIdentity = 0x800f,
};

Reason CheckParameter(std::uint16_t id, const Bytes& value)
{
  const auto has_size = [&](std::size_t size) -> Reason
  { return value.size() == size ? nullptr : "a parameter of another size than its kind has"; };
  const auto fits = [](bool does) -> Reason { return does ? nullptr : "a parameter whose parts do not fit into it"; };
  if (id >= kFirstSecurityParameter && id <= kLastSecurityParameter)
    return "a parameter of DDS Security, which no run uses";
  switch (id)
  {
    case kKeyHash:
    case kParticipantGuid:
    case kEndpointGuid:
    case kPersistenceGuid:
      return has_size(16);
    case kStatusInfo:
    case kProtocolVersion:
    case kVendorId:
      return has_size(4);
    case kUnicastLocator:
    case kMulticastLocator:
    case kDefaultUnicastLocator:
    case kDefaultMulticastLocator:
    case kMetatrafficUnicastLocator:
    case kMetatrafficMulticastLocator:
      return has_size(kLocatorBytes);
    case kRelatedSampleIdentity:
      return has_size(24);
    case kLease:
      if (value.size() == 8 && static_cast<std::int32_t>(value.Word(0)) < 0) return "a lease below zero";
      return has_size(8);
    case kTopicName:
    case kTypeName:
    case kEntityName:
    {
      Bytes rest = value;
      return fits(TakeString(rest));
    }
    case kPartition:
      return fits(HasStrings(value, 1));
    case kPropertyList:
      return fits(HasStrings(value, 2));
    case kContentFilter:
      return fits(IsContentFilter(value));
    case kUserData:
    case kGroupData:
    case kTopicData:
      return fits(HasItems(value, 1));
    case kDataRepresentation:
      return fits(HasItems(value, 2));
    case kDataSharing:
      return fits(HasItems(value, 8));
    case kTypeIdV1:
    case kTypeObjectV1:
    case kTypeInformation:
      return value.size() <= kMostTypeBytes ? nullptr : "a description of a type that is too long";
    default:
      return nullptr;
  }
}

struct ListEnd
{
  std::size_t at = 0;        // the position after the sentinel
  bool says_status = false;  // the instance is disposed of or unregistered
  bool only_disposes = false;
};

Reason CheckParameters(const Bytes& list, ListEnd& end)
{
  for (std::size_t at = 0;;)
  {
    if (list.size() - at < 4) return "a list of parameters without an end";
    const std::uint16_t id = list.Short(at);
    const std::size_t length = list.Short(at + 2);
    at += 4;
    if (id == kSentinel)
    {
      end.at = at;
      return nullptr;
    }
    if (length > list.size() - at || length % 4 != 0) return "a parameter that does not fit into its list";
    const Bytes value = list.Part(at, length);
    if (const Reason reason = CheckParameter(id, value)) return reason;
    if (id == kStatusInfo)
    {
      end.says_status = (value.Byte(3) & 3U) != 0;
      end.only_disposes = value.Byte(3) == 1;
    }
    at += length;
  }
}

// --- messages ------------------------------------------------------------------------------------------------------

using EntityId = std::array<std::uint8_t, 4>;

EntityId EntityAt(const Bytes& body, std::size_t at)
{
  return {body.Byte(at), body.Byte(at + 1), body.Byte(at + 2), body.Byte(at + 3)};
}

bool IsBuiltIn(const EntityId& writer) { return (writer[3] & 0xc0U) == 0xc0U; }

// Returns whether the writer is one of DDS itself: for participants, topics, writers and readers.
bool IsDiscovery(const EntityId& writer)
{
  if (writer[0] != 0 || writer[3] != 0xc2U) return false;
  return (writer[1] == 1 && writer[2] == 0) || (writer[1] == 0 && writer[2] >= 2 && writer[2] <= 4);
}

bool IsLiveliness(const EntityId& writer) { return writer == EntityId{0, 2, 0, 0xc2}; }

// Returns whether the writer is one of DDS Security: for secured discovery or for the exchange of tokens.
bool IsSecurity(const EntityId& writer)
{
  return IsBuiltIn(writer) && (writer[0] == 0xffU || (writer[0] == 0 && writer[1] == 2 && writer[2] == 1));
}

// Checks the part of a payload of a built-in writer that Fast DDS reads.
Reason CheckBuiltInPayload(const EntityId& writer, const Bytes& payload)
{
  if (IsLiveliness(writer))
    return payload.size() >= kLivelinessBytes ? nullptr : "a message of liveliness that is too short";
  if (!IsDiscovery(writer)) return nullptr;
  constexpr unsigned kListBigEndian = 2;
  constexpr unsigned kListLittleEndian = 3;
  if (payload.Byte(0) != 0 || (payload.Byte(1) != kListBigEndian && payload.Byte(1) != kListLittleEndian))
    return "a message of discovery that is no list of parameters";
  ListEnd end;
  return CheckParameters({payload.bytes.subspan(kEncapsulationBytes), payload.Byte(1) == kListLittleEndian}, end);
}

// Checks the inline quality of service, if it exists, and finds the begin of the payload.
Reason CheckInlineQos(const Bytes& body, std::size_t fixed_bytes, bool has_qos, ListEnd& end)
{
  // The field holds the number of bytes from its end to the list, which is the same in all versions of RTPS so far.
  if (body.Short(2) != fixed_bytes - 4) return "an inline quality of service at another place than RTPS says";
  end.at = 0;
  if (has_qos)
    if (const Reason reason = CheckParameters(body.From(fixed_bytes), end)) return reason;
  end.at += fixed_bytes;
  return nullptr;
}

Reason CheckData(const Bytes& body, unsigned flags)
{
  if (body.size() < kDataFixedBytes) return "a DATA that is too short";
  const EntityId writer = EntityAt(body, 8);
  if (IsSecurity(writer)) return "a message of DDS Security, which no run uses";
  if (!IsAmong(body.Number(12), 1, kLastNumber)) return "a DATA with a number that does not exist";
  ListEnd qos;
  if (const Reason reason = CheckInlineQos(body, kDataFixedBytes, (flags & kInlineQosFlag) != 0, qos)) return reason;
  // A reader of Fast DDS asserts that an instance whose writers are gone has no writer, and a disposal adds one.
  // Members dispose of nothing, and other vendors unregister in the same message.
  if (!IsBuiltIn(writer) && qos.only_disposes) return "a disposal, which no topic of a run has";
  const bool has_data = (flags & kDataFlag) != 0;
  const bool has_key = (flags & kKeyFlag) != 0;
  if (has_data && has_key) return "a DATA with both data and a key";
  if (!has_data && !has_key)
    return IsDiscovery(writer) && !qos.says_status ? "a message of discovery without data" : nullptr;
  const Bytes payload = body.From(qos.at);
  if (payload.size() < kEncapsulationBytes) return "a DATA without the data that its flags announce";
  return CheckBuiltInPayload(writer, payload);
}

Reason CheckDataFragment(const Bytes& body, unsigned flags, const RtpsLimits& limits)
{
  if (body.size() < kFragmentFixedBytes) return "a DATA_FRAG that is too short";
  // Announcements fit into one datagram. In fragments they could not be checked.
  if (IsBuiltIn(EntityAt(body, 8))) return "a DATA_FRAG of a writer of DDS itself";
  if (!IsAmong(body.Number(12), 1, kLastNumber)) return "a DATA_FRAG with a number that does not exist";
  if ((flags & kKeyOfFragmentFlag) != 0) return "a DATA_FRAG of a key";
  ListEnd qos;
  if (const Reason reason = CheckInlineQos(body, kFragmentFixedBytes, (flags & kInlineQosFlag) != 0, qos))
    return reason;

  const std::uint64_t start = body.Word(20);
  const std::uint32_t count = body.Short(24);
  const std::uint64_t size = body.Short(26);
  const std::uint64_t sample = body.Word(28);
  if (sample < 1 || sample > limits.sample_bytes) return "a DATA_FRAG of a message that its sender cannot have";
  if (size < kLeastFragment || size % 4 != 0) return "a DATA_FRAG of fragments of no usual size";
  // Fast DDS and Cyclone DDS send one fragment at a time. The space after a datagram (DiscardingTransport) is enough
  // for one.
  if (count != 1) return "a DATA_FRAG of several fragments";
  if (start < 1 || (start - 1) * size >= sample) return "a DATA_FRAG of a fragment that does not exist";
  const std::uint64_t needed = std::min(size, sample - (start - 1) * size);
  if (body.size() - qos.at < needed) return "a DATA_FRAG without the data of its fragment";
  return nullptr;
}

// --- the rest ------------------------------------------------------------------------------------------------------

bool TakeLocators(Bytes& from)
{
  if (!HasItems(from, kLocatorBytes)) return false;
  from = from.From(4 + from.Word(0) * kLocatorBytes);
  return true;
}

Reason CheckInfoReply(const Bytes& body, unsigned flags)
{
  Bytes rest = body;
  const bool fits = TakeLocators(rest) && ((flags & kMulticastFlag) == 0 || TakeLocators(rest));
  return fits ? nullptr : "an INFO_REPLY that is too short";
}

Reason CheckSubmessage(std::uint8_t kind, unsigned flags, const Bytes& body, const RtpsLimits& limits)
{
  if (kind >= kFirstOfSecurity && kind <= kLastOfSecurity) return "a submessage of DDS Security, which no run uses";
  switch (kind)
  {
    case kAckNack:
      return CheckAckNack(body);
    case kHeartbeat:
      return CheckHeartbeat(body, limits);
    case kGap:
      return CheckGap(body, limits);
    case kInfoTimestamp:
      return (flags & kInvalidateFlag) != 0 || body.size() >= 8 ? nullptr : "an INFO_TS that is too short";
    case kInfoSource:
      return body.size() == 20 ? nullptr : "an INFO_SRC of another size than RTPS says";
    case kInfoReplyIp4:
      return body.size() >= 8 ? nullptr : "an INFO_REPLY_IP4 that is too short";
    case kInfoDestination:
      return body.size() >= 12 ? nullptr : "an INFO_DST that is too short";
    case kInfoReply:
      return CheckInfoReply(body, flags);
    case kNackFragment:
      return CheckNackFragment(body);
    case kHeartbeatFragment:
      return CheckHeartbeatFragment(body);
    case kData:
      return CheckData(body, flags);
    case kDataFragment:
      return CheckDataFragment(body, flags, limits);
    default:
      // Receivers skip kinds that they do not know (DDSI-RTPS 2.2, 8.3.4.1), such as those of vendors.
      return nullptr;
  }
}

bool IsOfFastDds(std::span<const char> datagram)
{
  return std::memcmp(datagram.data() + 6, kVendorOfFastDds.data(), kVendorOfFastDds.size()) == 0;
}

}  // namespace
}  // namespace rtps_structure

RtpsVerdict CheckRtps(std::span<const char> datagram, const RtpsLimits& limits)
{
  using namespace rtps_structure;
  if (datagram.size() < kHeaderBytes || std::memcmp(datagram.data(), "RTPS", 4) != 0 || datagram[4] != kProtocolMajor)
    return {"it is no datagram of RTPS 2", 0};
  for (std::size_t at = kHeaderBytes; at < datagram.size();)
  {
    const std::size_t left = datagram.size() - at;
    if (left < 4) return {"a submessage that ends before its length", at};
    const Bytes here{datagram.subspan(at), (static_cast<unsigned char>(datagram[at + 1]) & kLittleEndianFlag) != 0};
    const std::uint8_t kind = here.Byte(0);
    const unsigned flags = here.Byte(1);
    std::size_t length = here.Short(2);
    // A length of 0 means the rest of the datagram, except for kinds whose header may be their end.
    if (length == 0 && kind != kPad && kind != kInfoTimestamp) length = left - 4;
    if (length > left - 4) return {"a submessage that is longer than its datagram", at};
    const bool is_last = length == left - 4;
    // Receivers disagree about the begin of the next submessage.
    if (!is_last && length % 4 != 0) return {"a submessage whose length is no multiple of 4", at};
    if (kind == kStatistics && IsOfFastDds(datagram))
    {
      if (is_last && length == kStatisticsBytes) return {nullptr, at};
      return {"statistics of Fast DDS at another place than the end", at};
    }
    if (const Reason reason = CheckSubmessage(kind, flags, here.Part(4, length), limits)) return {reason, at};
    at += 4 + length;
  }
  return {nullptr, datagram.size()};
}

}  // namespace swarmanoid
