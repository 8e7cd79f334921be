#include "common/bus/security/signed_transport.h"

#include <exception>
#include <vector>

#include <fmt/format.h>

#include "common/errors/print_error.h"

namespace swarmanoid
{
namespace
{

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

  void Receive(transport::TransportReceiverInterface& next, Datagram datagram, const rtps::Locator_t& local,
               const rtps::Locator_t& remote) override
  {
    DatagramSignatures::Checked checked;
    if (!Try([&] { checked = descriptor_.signatures->Check(datagram); })) return;
    if (checked.forged) return Tell(*checked.forged, TextOf(remote));
    if (checked.is_one_too_many)
      return Refuse(fmt::format("more than {} processes without the key of this run announce themselves",
                                DatagramSignatures::kMostStrangers),
                    remote);
    if (checked.is_of_stranger) checked.datagram = Check(checked.datagram, kStrangerLimits, remote);
    if (!checked.datagram.empty()) Pass(next, checked.datagram, local, remote);
  }

protected:
  bool Write(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first, rtps::LocatorsIterator& last,
             const Deadline& deadline) override
  {
    std::vector<char> room;
    Datagram with_signature;
    if (!Try([&] { with_signature = descriptor_.signatures->Sign(datagram, room); })) return false;
    return DiscardingTransport::Write(socket, with_signature, first, last, deadline);
  }

private:
  void Tell(const GuidPrefix& member, const std::string& sender) const
  {
    const std::lock_guard lock(descriptor_.listener->mutex);
    if (descriptor_.listener->forged) descriptor_.listener->forged(member, sender);
  }

  // No exception may reach DDS.
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
                                                     bool over_a_network,
                                                     std::shared_ptr<DatagramSignatures> its_signatures,
                                                     std::shared_ptr<DatagramListener> its_listener)
    : DiscardingTransportDescriptor(std::move(udp), over_a_network, std::move(its_listener)),
      signatures(std::move(its_signatures))
{
  maxMessageSize -= kSignatureBytes;
}

transport::TransportInterface* SignedTransportDescriptor::create_transport() const
{
  return new SignedTransport(*this);
}

}  // namespace swarmanoid
