#include "common/bus/security/discovery_pace.h"

#include <algorithm>

#include "common/bus/security/submessages.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kDestinationAt = 4, kDestinationBytes = 12;  // in INFO_DST
constexpr std::size_t kWriterOfHeartbeatAt = 8, kCountOfHeartbeatAt = 28, kCountBytes = 4;
constexpr char kBuiltinWriter =
    static_cast<char>(0xc2);  // the kind of writers with a key, in the last byte of their id

bool Has(std::span<const char> bytes, std::size_t at, std::size_t count) { return at + count <= bytes.size(); }

bool AddressesOneProcess(std::span<const char> submessage)
{
  return submessage[0] == kInfoDestinationKind && Has(submessage, kDestinationAt, kDestinationBytes) &&
         std::ranges::any_of(submessage.subspan(kDestinationAt, kDestinationBytes),
                             [](char byte) { return byte != 0; });
}

}  // namespace

std::string DiscoveryPace::WhatMayBeLeftOut(std::span<const char> datagram, bool spreads)
{
  std::string what;
  std::size_t at = kDatagramHeaderBytes;
  while (at + 4 <= datagram.size())
  {
    const std::span<const char> submessage = FirstSubmessage(datagram.subspan(at));
    if (AddressesOneProcess(submessage)) return {};
    if (IsAnnouncement(submessage)) return {datagram.begin(), datagram.end()};
    if (submessage[0] == kDataKind) return {};
    if (submessage[0] == kHeartbeatKind)
    {
      if (!Has(submessage, kCountOfHeartbeatAt, kCountBytes)) return {};
      if (spreads && submessage[kWriterOfHeartbeatAt + 3] != kBuiltinWriter) return {};
      if (what.empty()) what.assign(datagram.begin(), datagram.end());
      std::fill_n(what.begin() + static_cast<std::ptrdiff_t>(at + kCountOfHeartbeatAt), kCountBytes, '\0');
    }
    at += submessage.size();
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
