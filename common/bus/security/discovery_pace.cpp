#include "common/bus/security/discovery_pace.h"

#include <algorithm>
#include <cstring>

namespace swarmanoid
{
namespace
{

// RTPS 2.2, 8.3.7 (submessages), 9.3.1.3 (built-in writers) and 9.4.5 (layouts).
constexpr char kHeartbeat = 0x07, kInfoDestination = 0x0e, kData = 0x15;
constexpr std::size_t kRtpsHeaderBytes = 20;
constexpr std::size_t kDestinationAt = 4, kPrefixBytes = 12;  // in INFO_DST
constexpr std::size_t kDataWriterAt = 12;
constexpr std::size_t kHeartbeatWriterAt = 8, kHeartbeatCountAt = 28, kCountBytes = 4;
constexpr char kAnnouncer[4] = {0, 1, 0, static_cast<char>(0xc2)};
constexpr char kBuiltinWriter =
    static_cast<char>(0xc2);  // the kind of writers with a key, in the last byte of their id

bool Has(std::span<const char> bytes, std::size_t at, std::size_t count) { return at + count <= bytes.size(); }

}  // namespace

std::string DiscoveryPace::WhatMayBeLeftOut(std::span<const char> datagram, bool spreads)
{
  std::string what;
  for (std::size_t at = kRtpsHeaderBytes; at + 4 <= datagram.size();)
  {
    const std::span<const char> submessage = datagram.subspan(at);
    if (submessage[0] == kInfoDestination && Has(submessage, kDestinationAt, kPrefixBytes) &&
        std::ranges::any_of(submessage.subspan(kDestinationAt, kPrefixBytes), [](char byte) { return byte != 0; }))
      return {};
    if (submessage[0] == kData)
    {
      const bool announces = Has(submessage, kDataWriterAt, sizeof kAnnouncer) &&
                             std::memcmp(&submessage[kDataWriterAt], kAnnouncer, sizeof kAnnouncer) == 0;
      return announces ? std::string(datagram.begin(), datagram.end()) : std::string();
    }
    if (submessage[0] == kHeartbeat)
    {
      if (!Has(submessage, kHeartbeatCountAt, kCountBytes)) return {};
      if (spreads && submessage[kHeartbeatWriterAt + 3] != kBuiltinWriter) return {};
      if (what.empty()) what.assign(datagram.begin(), datagram.end());
      std::fill_n(what.begin() + static_cast<std::ptrdiff_t>(at + kHeartbeatCountAt), kCountBytes, '\0');
    }
    const auto byte = [&](std::size_t k) { return std::size_t{static_cast<unsigned char>(submessage[k])}; };
    at += 4 + ((byte(1) & 1U) != 0 ? byte(2) | byte(3) << 8U : byte(3) | byte(2) << 8U);
  }
  return what;
}

bool DiscoveryPace::IsEarly(const std::string& what, const Way& way, Clock::time_point now)
{
  std::string key = what;
  key.append(reinterpret_cast<const char*>(&way.first), sizeof way.first);
  key.append(reinterpret_cast<const char*>(&way.second), sizeof way.second);
  Said& said = said_[std::move(key)];
  if (said.times >= kFirst && now - said.last < kPause) return true;
  said = {now, said.times + 1};
  if (said_.size() > most_)
  {
    std::erase_if(said_, [&](const auto& old) { return now - old.second.last >= kPause; });
    most_ = std::max<std::size_t>(1024, 2 * said_.size());
  }
  return false;
}

}  // namespace swarmanoid
