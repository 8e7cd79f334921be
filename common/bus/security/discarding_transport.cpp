#include "common/bus/security/discarding_transport.h"

#include <cstring>

#include <fmt/format.h>

namespace swarmanoid
{
namespace
{

std::uint64_t AddressAndPort(const rtps::Locator_t& locator)
{
  std::uint32_t address = 0;
  std::memcpy(&address, locator.address + sizeof locator.address - sizeof address, sizeof address);
  return std::uint64_t{address} << 32U | locator.port;
}

}  // namespace

rtps::Locator_t NowhereLocator()
{
  rtps::Locator_t nowhere;
  nowhere.kind = LOCATOR_KIND_SHM;
  nowhere.port = 1;
  return nowhere;
}

transport::TransportInterface* DiscardingTransportDescriptor::create_transport() const
{
  return new DiscardingTransport(*this);
}

DiscardingTransport::DiscardingTransport(const DiscardingTransportDescriptor& descriptor)
    : FilterTransport(descriptor), descriptor_(descriptor)
{
}

void DiscardingTransport::select_locators(rtps::LocatorSelector& selector) const
{
  ChainingTransport::select_locators(selector);
  const auto& entries = selector.transport_starts();
  for (std::size_t k = 0; k < entries.size(); ++k)
  {
    rtps::LocatorSelectorEntry& reader = *entries[k];
    if (!reader.enabled || !reader.multicast.empty()) continue;
    if (reader.unicast.empty()) reader.unicast.push_back(NowhereLocator());
    if (reader.unicast[0] != NowhereLocator()) continue;
    reader.state.unicast.push_back(0);
    selector.select(k);
  }
}

bool DiscardingTransport::Send(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first,
                               rtps::LocatorsIterator& last, const Deadline& deadline)
{
  while (first != last && *first == NowhereLocator()) ++first;
  if (first == last) return true;
  const std::string what = DiscoveryPace::WhatMayBeLeftOut(datagram, descriptor_.spreads);
  if (what.empty()) return Write(socket, datagram, first, last, deadline);
  transport::LocatorList due;
  {
    const std::lock_guard lock(mutex_);
    const auto now = DiscoveryPace::Clock::now();
    for (; first != last; ++first)
      if (!pace_.IsEarly(what, {&socket, AddressAndPort(*first)}, now)) due.push_back(*first);
  }
  transport::Locators begin(due.begin());
  transport::Locators end(due.end());
  return due.empty() || Write(socket, datagram, begin, end, deadline);
}

void DiscardingTransport::Refuse(const std::string& what, const rtps::Locator_t& remote)
{
  const std::lock_guard lock(descriptor_.listener->mutex);
  if (descriptor_.listener->malformed)
    descriptor_.listener->malformed(fmt::format("{}; it came from port {}", what, remote.port),
                                    rtps::IPLocator::toIPv4string(remote));
}

}  // namespace swarmanoid
