#include "common/bus/discarding_transport.h"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>

#include <fmt/format.h>

namespace swarmanoid
{
namespace
{

// A reader of Fast DDS that has begun to put a message together copies as many bytes as the last fragment of that
// message has, even if the datagram that ends it has fewer. Fragments have less than 64 KiB, and so has the datagram
// before them. The room behind it is never filled, and a message with bytes from there is dropped as damaged.
constexpr std::uint32_t kRoomForDatagrams = 128U * 1024U;

}  // namespace

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

bool DiscardingTransport::OpenInputChannel(const rtps::Locator_t& locator,
                                           transport::TransportReceiverInterface* receiver,
                                           std::uint32_t max_message_size)
{
  return ChainingTransport::OpenInputChannel(locator, receiver, std::max(max_message_size, kRoomForDatagrams));
}

void DiscardingTransport::receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes,
                                  std::uint32_t size, const rtps::Locator_t& local, const rtps::Locator_t& remote)
{
  const auto datagram = Read({reinterpret_cast<const char*>(bytes), size}, kMemberLimits, remote);
  if (!datagram.empty()) Pass(next, datagram, local, remote);
}

std::span<const char> DiscardingTransport::Read(std::span<const char> datagram, const RtpsLimits& limits,
                                                const rtps::Locator_t& remote) const
{
  const RtpsVerdict verdict = CheckRtps(datagram, limits);
  if (verdict.defect == nullptr) return datagram.first(verdict.bytes);
  TellMalformed(fmt::format("{}, at byte {} of {}", verdict.defect, verdict.bytes, datagram.size()), remote);
  return {};
}

void DiscardingTransport::TellMalformed(const std::string& what, const rtps::Locator_t& remote) const
{
  const std::lock_guard lock(descriptor_.listener->mutex);
  if (descriptor_.listener->malformed)
    descriptor_.listener->malformed(fmt::format("{}; it came from port {}", what, remote.port),
                                    rtps::IPLocator::toIPv4string(remote));
}

void DiscardingTransport::Pass(transport::TransportReceiverInterface* next, std::span<const char> datagram,
                               const rtps::Locator_t& local, const rtps::Locator_t& remote)
{
  next->OnDataReceived(reinterpret_cast<const rtps::octet*>(datagram.data()),
                       static_cast<std::uint32_t>(datagram.size()), local, remote);
}

}  // namespace swarmanoid
