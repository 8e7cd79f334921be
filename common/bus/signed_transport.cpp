#include "common/bus/signed_transport.h"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastrtps/utils/IPLocator.h>

#include <exception>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "common/activity/print_error.h"

namespace swarmanoid
{
namespace
{

namespace transport = eprosima::fastdds::rtps;
namespace rtps = eprosima::fastrtps::rtps;

constexpr auto kSignatureBytes = static_cast<std::uint32_t>(DatagramSignatures::kBytes);

std::string TextOf(const rtps::Locator_t& locator)
{
  return fmt::format("{} port {}", rtps::IPLocator::toIPv4string(locator), locator.port);
}

class SignedTransport : public DiscardingTransport
{
public:
  explicit SignedTransport(const SignedTransportDescriptor& descriptor)
      : DiscardingTransport(descriptor), descriptor_(descriptor)
  {
  }

  bool send(rtps::SenderResource* below, const rtps::octet* bytes, std::uint32_t size, rtps::LocatorsIterator* first,
            rtps::LocatorsIterator* last, const std::chrono::steady_clock::time_point& timeout) override
  {
    if (!HasDestination(*first, *last)) return true;
    std::vector<char> room;
    std::span<const char> datagram;
    if (!Try([&] { datagram = descriptor_.signatures->Sign({reinterpret_cast<const char*>(bytes), size}, room); }))
      return false;
    return below->send(reinterpret_cast<const rtps::octet*>(datagram.data()),
                       static_cast<std::uint32_t>(datagram.size()), first, last, timeout);
  }

  void receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& local, const rtps::Locator_t& remote) override
  {
    const auto datagram = Read({reinterpret_cast<const char*>(bytes), size}, kMemberLimits, remote);
    if (datagram.empty()) return;
    DatagramSignatures::Checked checked;
    if (!Try([&] { checked = descriptor_.signatures->Check(datagram); })) return;
    if (checked.forged) return Tell(*checked.forged, TextOf(remote));
    if (checked.is_one_too_many)
      return TellMalformed(fmt::format("more than {} processes without the key of this run announce themselves",
                                       DatagramSignatures::kMostStrangers),
                           remote);
    if (checked.is_of_stranger) checked.datagram = Read(checked.datagram, kStrangerLimits, remote);
    if (!checked.datagram.empty()) Pass(next, checked.datagram, local, remote);
  }

private:
  void Tell(const GuidPrefix& member, const std::string& sender) const
  {
    const std::lock_guard lock(descriptor_.listener->mutex);
    if (descriptor_.listener->forged) descriptor_.listener->forged(member, sender);
  }

  // Nothing is ever thrown into DDS.
  static bool Try(const std::function<void()>& call)
  {
    try
    {
      call();
      return true;
    }
    catch (const std::exception& error)
    {
      PrintError("dropped a datagram: {}\n", error.what());
      return false;
    }
  }

  SignedTransportDescriptor descriptor_;
};

}  // namespace

SignedTransportDescriptor::SignedTransportDescriptor(std::shared_ptr<transport::TransportDescriptorInterface> udp,
                                                     std::shared_ptr<DatagramSignatures> its_signatures,
                                                     std::shared_ptr<DatagramListener> its_listener)
    : DiscardingTransportDescriptor(std::move(udp), std::move(its_listener)), signatures(std::move(its_signatures))
{
  maxMessageSize -= kSignatureBytes;
}

transport::TransportInterface* SignedTransportDescriptor::create_transport() const
{
  return new SignedTransport(*this);
}

}  // namespace swarmanoid
