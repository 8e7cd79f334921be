// The submessages of a datagram of RTPS, as far as our transports look at them (RTPS 2.2, 8.3.7, 9.3.1.3 and 9.4.5).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace swarmanoid
{

inline constexpr std::size_t kDatagramHeaderBytes = 20;
inline constexpr char kPadKind = 0x01;
inline constexpr char kHeartbeatKind = 0x07;
inline constexpr char kInfoTimestampKind = 0x09;
inline constexpr char kInfoDestinationKind = 0x0e;
inline constexpr char kDataKind = 0x15;
inline constexpr std::size_t kWriterOfDataAt = 12;  // in a submessage with data, with its header

// Returns the first submessage. It has its own length, or extends to the end. `bytes` has at least its header.
inline std::span<const char> FirstSubmessage(std::span<const char> bytes)
{
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  const bool is_little_endian = (byte(1) & 1U) != 0;
  const std::size_t length = is_little_endian ? byte(2) | (byte(3) << 8U) : byte(3) | (byte(2) << 8U);
  const bool may_be_empty = bytes[0] == kPadKind || bytes[0] == kInfoTimestampKind;
  if (length == 0 && !may_be_empty) return bytes;
  return bytes.first(std::min(bytes.size(), 4 + ((length + 3) & ~std::size_t{3})));
}

inline bool StandsAt(std::span<const char> bytes, std::span<const char> what, std::size_t at)
{
  return at + what.size() <= bytes.size() && std::ranges::equal(what, bytes.subspan(at, what.size()));
}

// Returns whether it is data of the writer that announces processes.
inline bool IsAnnouncement(std::span<const char> submessage)
{
  constexpr std::array<char, 4> kAnnouncer{0, 1, 0, static_cast<char>(0xc2)};
  return submessage[0] == kDataKind && StandsAt(submessage, kAnnouncer, kWriterOfDataAt);
}

}  // namespace swarmanoid
