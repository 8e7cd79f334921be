#include "common/bus/discarding_transport.h"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>

namespace swarmanoid
{

namespace transport = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

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
    : ChainingTransport(descriptor), descriptor_(descriptor)
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

bool DiscardingTransport::send(rtps::SenderResource* below, const rtps::octet* bytes, std::uint32_t size,
                               rtps::LocatorsIterator* first, rtps::LocatorsIterator* last,
                               const std::chrono::steady_clock::time_point& timeout)
{
  return !HasDestination(*first, *last) || below->send(bytes, size, first, last, timeout);
}

void DiscardingTransport::receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes,
                                  std::uint32_t size, const rtps::Locator_t& local, const rtps::Locator_t& remote)
{
  next->OnDataReceived(bytes, size, local, remote);
}

}  // namespace swarmanoid
