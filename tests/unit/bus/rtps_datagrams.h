// Datagrams of RTPS for the tests and the fuzzer of CheckRtps: one valid datagram of each kind, and datagrams that end
// processes with Fast DDS or make them fill their memory.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace swarmanoid::test
{

struct RtpsDatagram
{
  std::string name;
  std::string bytes;
  std::string defect{};  // a part of the reason for the refusal; empty if Fast DDS may read it
};

inline void PrintTo(const RtpsDatagram& datagram, std::ostream* to) { *to << datagram.name; }

inline constexpr unsigned kInlineQos = 2;
inline constexpr unsigned kHasData = 4;
inline constexpr unsigned kHasKey = 8;

inline std::string LittleEndian(std::uint64_t value, unsigned bytes)
{
  std::string text;
  for (unsigned k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k));
  return text;
}
inline std::string Short(std::uint64_t value) { return LittleEndian(value, 2); }
inline std::string Word(std::uint64_t value) { return LittleEndian(value, 4); }
inline std::string SequenceNumber(std::int64_t value)
{
  return Word(static_cast<std::uint64_t>(value) >> 32U) + Word(static_cast<std::uint64_t>(value));
}
inline std::string Id(std::uint32_t id)
{
  return {static_cast<char>(id >> 24U), static_cast<char>(id >> 16U), static_cast<char>(id >> 8U),
          static_cast<char>(id)};
}
inline std::string CdrString(const std::string& text)
{
  std::string bytes = Word(text.size() + 1) + text + '\0';
  bytes.resize((bytes.size() + 3) / 4 * 4);
  return bytes;
}

inline const std::string kUnknown(4, '\0');
inline const std::string kTellsParticipants = Id(0x000100c2);
inline const std::string kTellsTheirWriters = Id(0x000003c2);
inline const std::string kTellsLiveliness = Id(0x000200c2);
inline const std::string kUserWriter = Id(0x00000103);
inline const std::string kVendorFastDds{0x01, 0x0f};

// `vendor` has two bytes.
inline std::string RtpsHeader(const std::string& vendor = kVendorFastDds)
{
  return std::string("RTPS\2\3", 6) + vendor + "the stranger";
}

inline std::string RtpsSubmessage(unsigned kind, unsigned flags, const std::string& body)
{
  return std::string{static_cast<char>(kind), static_cast<char>(flags | 1U)} + Short(body.size()) + body;
}

inline std::string Parameter(unsigned id, const std::string& value) { return Short(id) + Short(value.size()) + value; }
inline const std::string kListEnd = Parameter(0x0001, "");
inline const std::string kListEncapsulation("\0\3\0\0", 4);
inline const std::string kPlainEncapsulation("\0\1\0\0", 4);

inline std::string Data(const std::string& writer, unsigned flags, const std::string& rest, std::int64_t number = 1)
{
  return RtpsSubmessage(0x15, flags, Short(0) + Short(16) + kUnknown + writer + SequenceNumber(number) + rest);
}
inline std::string Announcement(const std::string& parameters)
{
  return RtpsHeader() + Data(kTellsParticipants, kHasData, kListEncapsulation + parameters);
}

struct Fragment
{
  std::uint32_t start = 1;
  std::uint32_t count = 1;
  std::uint32_t size = 1024;
  std::uint32_t sample = 2000;
  std::string writer = kUserWriter;
  unsigned flags = 0;
  std::int64_t number = 1;
};
inline std::string DataFragment(const Fragment& fragment, const std::string& rest)
{
  return RtpsSubmessage(0x16, fragment.flags,
                        Short(0) + Short(28) + kUnknown + fragment.writer + SequenceNumber(fragment.number) +
                            Word(fragment.start) + Short(fragment.count) + Short(fragment.size) +
                            Word(fragment.sample) + rest);
}
inline std::string Heartbeat(std::int64_t first, std::int64_t last)
{
  return RtpsSubmessage(0x07, 0, kUnknown + kUserWriter + SequenceNumber(first) + SequenceNumber(last) + Word(1));
}
// `bits`: the stated number of bits; one word follows.
inline std::string Gap(std::int64_t start, std::int64_t end, std::uint32_t bits = 0)
{
  return RtpsSubmessage(
      0x08, 0,
      kUnknown + kUserWriter + SequenceNumber(start) + SequenceNumber(end) + Word(bits) + (bits > 0 ? Word(~0U) : ""));
}
inline std::string AckNack(std::int64_t base, std::uint32_t bits)
{
  return RtpsSubmessage(
      0x06, 0, kUnknown + kUserWriter + SequenceNumber(base) + Word(bits) + (bits > 0 ? Word(~0U) : "") + Word(1));
}
inline std::string NackFragment(std::uint32_t base, std::uint32_t bits, std::int64_t number = 1)
{
  return RtpsSubmessage(0x12, 0,
                        kUnknown + kUserWriter + SequenceNumber(number) + Word(base) + Word(bits) +
                            (bits > 0 ? Word(~0U) : "") + Word(1));
}
inline std::string Statistics(std::size_t bytes = 56) { return RtpsSubmessage(0x80, 0, std::string(bytes, '\0')); }

// Returns the parameters with which a process announces itself.
inline std::string OwnParameters()
{
  const std::string locator = Word(1) + Word(7411) + std::string(12, '\0') + "\x7f" + std::string("\0\0\1", 3);
  return Parameter(0x15, std::string("\2\3\0\0", 4)) + Parameter(0x16, std::string("\1\x0f\0\0", 4)) +
         Parameter(0x50, "the stranger" + Id(0x000001c1)) + Parameter(0x02, Word(20) + Word(0)) +
         Parameter(0x58, Word(0x3f)) + Parameter(0x31, locator) + Parameter(0x32, locator) +
         Parameter(0x62, CdrString("engine")) + Parameter(0x2c, Word(5) + "a:123" + std::string(3, '\0')) +
         Parameter(0x59, Word(1) + CdrString("key") + CdrString("value")) + kListEnd;
}

inline std::vector<RtpsDatagram> LegalDatagrams()
{
  const std::string header = RtpsHeader();
  const std::string payload = kPlainEncapsulation + "text";
  const std::string disposal = Parameter(0x70, std::string(16, 'k')) + Parameter(0x71, std::string("\0\0\0\3", 4));
  const std::string endpoint =
      Parameter(0x5a, std::string(16, 'w')) + Parameter(0x05, CdrString("World")) +
      Parameter(0x07, CdrString("swarmanoid::World")) + Parameter(0x29, Word(1) + CdrString("diffusion_10")) +
      Parameter(0x73, Word(1) + Short(0) + Short(0)) + Parameter(0x8006, Word(1) + std::string(8, 'd')) +
      Parameter(0x35, CdrString("a") + CdrString("b") + CdrString("c") + CdrString("d") + Word(1) + CdrString("e")) +
      Parameter(0x75, std::string(64, 't')) + kListEnd;
  const std::string fragment(1024, 'f');
  return {
      {"Nothing", header},
      {"DataOfTheProgram", header + Data(kUserWriter, kHasData, payload)},
      {"DataWithInlineQos",
       header + Data(kUserWriter, kHasData | kInlineQos, Parameter(0x800f, std::string(24, 'i')) + kListEnd + payload)},
      {"DataWithoutPayload", header + Data(kUserWriter, 0, "")},
      {"KeyOfTheProgram", header + Data(kUserWriter, kHasKey | kInlineQos, disposal + kListEnd + payload)},
      {"DataUpToTheEnd", header + std::string("\x15\5\0\0", 4) + Data(kUserWriter, kHasData, payload).substr(4)},
      {"UnalignedDataAtTheEnd", header + Data(kUserWriter, kHasData, payload + "x")},
      {"Announcement", Announcement(OwnParameters())},
      {"GoodBye", header + Data(kTellsParticipants, kInlineQos, disposal + kListEnd)},
      {"Endpoint", header + Data(kTellsTheirWriters, kHasData, kListEncapsulation + endpoint)},
      {"EndpointThatIsGone",
       header + Data(kTellsTheirWriters, kHasKey | kInlineQos,
                     disposal + kListEnd + kListEncapsulation + Parameter(0x5a, std::string(16, 'w')) + kListEnd)},
      {"Liveliness", header + Data(kTellsLiveliness, kHasData, kPlainEncapsulation + std::string(20, '\0'))},
      {"FirstFragment", header + DataFragment({.start = 1}, fragment)},
      {"LastFragment", header + DataFragment({.start = 2}, std::string(976, 'f'))},
      {"FragmentWithInlineQos", header + DataFragment({.start = 1, .flags = kInlineQos}, kListEnd + fragment)},
      {"HeartbeatOfNothing", header + Heartbeat(1, 0)},
      {"Heartbeat", header + Heartbeat(5, 80)},
      {"Gap", header + Gap(5, 6)},
      {"GapWithBits", header + Gap(5, 300, 32)},
      {"AcknowledgementOfNothing", header + AckNack(0, 0)},
      {"Acknowledgement", header + AckNack(7, 3)},
      {"MissingFragments", header + NackFragment(1, 2)},
      {"HeartbeatOfFragments",
       header + RtpsSubmessage(0x13, 0, kUnknown + kUserWriter + SequenceNumber(1) + Word(3) + Word(1))},
      {"Destination", header + RtpsSubmessage(0x0e, 0, std::string(12, 'd')) + Heartbeat(1, 0)},
      {"Source", header + RtpsSubmessage(0x0c, 0, std::string(20, 's')) + Heartbeat(1, 0)},
      {"Time", header + RtpsSubmessage(0x09, 0, std::string(8, 't')) + Data(kUserWriter, kHasData, payload)},
      {"NoTime", header + RtpsSubmessage(0x09, 2, "") + Data(kUserWriter, kHasData, payload)},
      {"Padding", header + RtpsSubmessage(0x01, 0, "") + Heartbeat(1, 0)},
      {"Reply", header + RtpsSubmessage(0x0f, 2, Word(1) + std::string(24, 'l') + Word(0)) + Heartbeat(1, 0)},
      {"OfAVendor", header + RtpsSubmessage(0x9d, 0, std::string(36, 'v'))},
      {"StatisticsOfAnotherVendor", RtpsHeader("\1\x10") + Statistics(8) + Heartbeat(1, 0)},
  };
}

// Datagrams of the published vulnerabilities of Fast DDS, as far as a single datagram can show them, and of
// vulnerabilities that were found here. The datagram of CVE-2023-50257 has no defect in itself: it is a forged Leave of
// another process, which is refused by its signature.
inline std::vector<RtpsDatagram> AttackDatagrams()
{
  const std::string header = RtpsHeader();
  const std::string guid = Parameter(0x50, "the stranger" + Id(0x000001c1));
  // A token is a string and two lists of properties.
  const auto token = [&](const std::string& lists)
  { return guid + Parameter(0x1001, CdrString("t") + lists) + kListEnd; };
  constexpr std::int64_t kMost = 0x7fffffffffffffff;
  return {
      {"CVE_2023_39534_GapBeforeTheFirst", header + Gap(1, 0), "a GAP of numbers that do not exist"},
      {"CVE_2023_39949_HeartbeatFromZero", header + Heartbeat(0, 0), "a HEARTBEAT of numbers"},
      {"CVE_2023_39949_HeartbeatFromBelowZero", header + Heartbeat(-kMost - 1, 5), "a HEARTBEAT of numbers"},
      {"CVE_2023_39945_AnnouncementThatIsNoList",
       header + Data(kTellsParticipants, kHasData, std::string("\0\x7f\0\0", 4) + OwnParameters()), "no list"},
      {"CVE_2023_39946_PropertyLongerThanItsList",
       Announcement(guid + Parameter(0x59, Word(1) + Word(4000) + std::string("key\0", 4) + CdrString("value")) +
                    kListEnd),
       "parts do not fit"},
      {"CVE_2023_39947_MorePropertiesThanThere",
       Announcement(guid + Parameter(0x59, Word(~0U) + CdrString("key") + CdrString("value")) + kListEnd),
       "parts do not fit"},
      {"CVE_2023_39948_AnnouncementWithAnUnknownEncoding",
       header + Data(kTellsTheirWriters, kHasData, std::string("\0\x0b\0\0", 4) + OwnParameters()), "no list"},
      {"CVE_2023_42459_DataWithInlineQosThatRunsOut",
       header + Data(kUserWriter, kHasData | kInlineQos,
                     Parameter(0x71, std::string("\0\0\0\1", 4)) + Short(0x70) + Short(16)),
       "does not fit into its list"},
      {"CVE_2023_50716_FragmentWithEmptyInlineQos",
       header + DataFragment({.size = 4, .sample = 4, .writer = Id(0x00000303), .flags = kInlineQos, .number = 31},
                             kListEnd),
       "a DATA_FRAG of fragments of no usual size"},
      {"CVE_2023_50716_FragmentWithoutData",
       header + DataFragment({.writer = Id(0x00000303), .flags = kInlineQos, .number = 31}, kListEnd),
       "without the data of its fragment"},
      {"CVE_2024_28231_DataThatEndsBeforeItsInlineQos",
       header + std::string("\x15\7\x18\0", 4) +
           Data(kTellsParticipants, 0, Parameter(0x0888, std::string(32, '\0')) + kListEnd).substr(4),
       "does not fit into its list"},
      {"CVE_2024_30258_TokenWithMoreProperties", Announcement(token(Word(0x0fffffff) + Word(0))), "DDS Security"},
      {"CVE_2024_30259_TokenWithMoreBinaryProperties", Announcement(token(Word(0) + Word(0x0fffffff))), "DDS Security"},
      {"CVE_2025_62599_TokenWhoseListOverflows", Announcement(token(Word(0x10000001) + Word(0))), "DDS Security"},
      {"CVE_2025_62600_TokenWhoseBinaryListOverflows", Announcement(token(Word(0) + Word(0x15555556))), "DDS Security"},
      {"CVE_2025_62601_TokenWithALongString",
       Announcement(guid + Parameter(0x1002, Word(~0U) + std::string("t\0\0\0", 4)) + kListEnd), "DDS Security"},
      {"CVE_2025_62602_TokenWithALongVector",
       Announcement(token(Word(0) + Word(1) + CdrString("b") + Word(0xfffffff0))), "DDS Security"},
      {"CVE_2025_62603_MessageOfDdsSecurity",
       header + Data(Id(0x000201c3), kHasData, kPlainEncapsulation + std::string(60, '\xff')), "DDS Security"},
      {"CVE_2025_64098_PermissionsToken", Announcement(guid + Parameter(0x1002, Word(~0U)) + kListEnd), "DDS Security"},
      {"CVE_2025_64438_GapWithoutAnEnd", header + Gap(1, std::int64_t{1} << 40), "more than 10,000"},
      {"SubmessageOfDdsSecurity", header + RtpsSubmessage(0x31, 0, std::string(40, '\0')), "DDS Security"},
      {"HeartbeatUpToTheLast", header + Heartbeat(1, kMost), "a HEARTBEAT of numbers that do not exist"},
      {"FragmentOfAKey", header + DataFragment({.flags = 4}, std::string(1024, 'k')), "a DATA_FRAG of a key"},
      {"MissingFragmentZero", header + NackFragment(0, 32), "fragments that do not exist"},
      {"DisposalAmongMessages",
       header + Data(kUserWriter, kInlineQos, Parameter(0x71, std::string("\0\0\0\1", 4)) + kListEnd), "a disposal"},
      {"StatisticsInTheMiddle", header + Statistics() + Heartbeat(1, 0), "statistics of Fast DDS"},
      {"ManyRepresentations", Announcement(Parameter(0x73, Word(~0U)) + kListEnd), "parts do not fit"},
      {"LivelinessOfOneByte",
       header + Data(kTellsLiveliness, kHasData | kInlineQos,
                     Parameter(0x70, std::string(16, 'k')) + kListEnd + kPlainEncapsulation + "x"),
       "a message of liveliness that is too short"},
  };
}

}  // namespace swarmanoid::test
