#include "common/bus/security/discarding_transport.h"

#include <fmt/format.h>

namespace swarmanoid
{

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

bool DiscardingTransport::HasDestination(rtps::LocatorsIterator& first, const rtps::LocatorsIterator& last)
{
  while (first != last && *first == NowhereLocator()) ++first;
  return first != last;
}

bool DiscardingTransport::Send(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first,
                               rtps::LocatorsIterator& last, const Deadline& deadline)
{
  return !HasDestination(first, last) || SendDatagram(socket, datagram, first, last, deadline);
}

void DiscardingTransport::Refuse(const std::string& what, const rtps::Locator_t& remote)
{
  const std::lock_guard lock(descriptor_.listener->mutex);
  if (descriptor_.listener->malformed)
    descriptor_.listener->malformed(fmt::format("{}; it came from port {}", what, remote.port),
                                    rtps::IPLocator::toIPv4string(remote));
}

}  // namespace swarmanoid
