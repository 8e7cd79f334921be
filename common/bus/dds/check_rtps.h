// The structure of a datagram of RTPS (DDSI-RTPS 2.2), checked before Fast DDS reads it. The parsers of all versions of
// Fast DDS that distributions have packaged trust lengths and numbers in a datagram: a single datagram ends a process,
// or makes it fill its memory. The transport drops what this function refuses. It needs no key and includes no header
// of Fast DDS.
//
// An accepted datagram has submessages, parameter lists, number sets and fragments that lie within their bounds. Its
// numbers make Fast DDS neither overflow nor count for long. docs/security.md lists what is refused, and why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace swarmanoid
{

// The largest numbers that a sender may use. Structure cannot tell a number of a long run from an invented one. So
// members of a run get limits that a run never reaches, and others get limits that cost nothing.
struct RtpsLimits
{
  // It is the first number of a HEARTBEAT. A reader of Fast DDS counts from the last number that it knows to this one,
  // about 4,000 in a millisecond with 2.9.1. Meanwhile it holds the thread that hears all others.
  std::int64_t heartbeat_first = 0;
  // The end of a GAP. A reader of Fast DDS keeps 48 bytes for each number of a GAP that is ahead of what it has.
  std::int64_t gap_end = 0;
  // Bytes of a message in fragments. A reader of Fast DDS allocates all of it when the first fragment arrives.
  std::uint32_t sample_bytes = 0;
};

// A topic has one message a tick at most. Over a network a run makes 3,500 ticks a second at most, so that it reaches
// the first number after two weeks at full speed. Runs on one machine have no HEARTBEAT for messages of a tick. The
// largest message is a World, with the experiment and its checkpoint. These limits do not protect a run from its own
// members.
inline constexpr RtpsLimits kMemberLimits{
    .heartbeat_first = std::int64_t{1} << 32, .gap_end = std::int64_t{1} << 60, .sample_bytes = 1U << 28};

// Processes without the key of the run announce their endpoints, and holders of grants send requests. These messages
// are few and small.
inline constexpr RtpsLimits kStrangerLimits{.heartbeat_first = 200'000, .gap_end = 4'096, .sample_bytes = 256U * 1024U};

struct RtpsVerdict
{
  const char* defect = nullptr;  // for people; nullptr if Fast DDS may read the datagram
  // With a defect: the offset of its submessage. Otherwise: the number of bytes that Fast DDS may read, which are all
  // but the statistics at the end. Fast DDS compares the numbers in the statistics by assertions.
  std::size_t bytes = 0;
};

// Does not throw and does not allocate. The time is proportional to the number of submessages and parameters, not to
// that of bytes.
RtpsVerdict CheckRtps(std::span<const char> datagram, const RtpsLimits& limits = kMemberLimits);

}  // namespace swarmanoid
