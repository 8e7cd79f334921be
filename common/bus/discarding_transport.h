// A transport of Fast DDS that reads datagrams before Fast DDS does, and drops those that CheckRtps refuses. Messages
// to readers without an address are discarded.
//
// A reader that shares memory has no address. If its memory cannot be opened, since its process has just ended, Fast
// DDS (2.9) writes to it over the network, and tries for ever to send the fragments of a message that has no
// destination (StatefulWriter::deliver_sample_to_network goes on only once a fragment was sent to somebody).
#pragma once

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "common/bus/check_rtps.h"
#include "common/bus/datagram_signatures.h"

namespace swarmanoid
{

// The address of endpoints that hear nobody over the network: of a kind that no transport here speaks.
eprosima::fastrtps::rtps::Locator_t NowhereLocator();

// Called in threads of the transport. The functions are empty once the bus goes: a participant may outlive it until the
// program ends.
struct DatagramListener
{
  std::mutex mutex;
  // A datagram was dropped: what is wrong with it, and the address that it came from.
  std::function<void(const std::string& what, const std::string& address)> malformed;
  // A process in whose name a stranger spoke, and the address and port of the stranger.
  std::function<void(const GuidPrefix& member, const std::string& sender)> forged;
};

struct DiscardingTransportDescriptor : eprosima::fastdds::rtps::ChainingTransportDescriptor
{
  DiscardingTransportDescriptor(std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp,
                                std::shared_ptr<DatagramListener> its_listener)
      : ChainingTransportDescriptor(std::move(udp)), listener(std::move(its_listener))
  {
  }

  eprosima::fastdds::rtps::TransportInterface* create_transport() const override;
  std::uint32_t max_message_size() const override { return maxMessageSize; }

  const std::shared_ptr<DatagramListener> listener;
};

class DiscardingTransport : public eprosima::fastdds::rtps::ChainingTransport
{
public:
  explicit DiscardingTransport(const DiscardingTransportDescriptor& descriptor);

  eprosima::fastdds::rtps::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }
  bool OpenInputChannel(const eprosima::fastrtps::rtps::Locator_t& locator,
                        eprosima::fastdds::rtps::TransportReceiverInterface* receiver,
                        std::uint32_t max_message_size) override;
  void select_locators(eprosima::fastrtps::rtps::LocatorSelector& selector) const override;
  bool send(eprosima::fastrtps::rtps::SenderResource* below, const eprosima::fastrtps::rtps::octet* bytes,
            std::uint32_t size, eprosima::fastrtps::rtps::LocatorsIterator* first,
            eprosima::fastrtps::rtps::LocatorsIterator* last,
            const std::chrono::steady_clock::time_point& timeout) override;
  void receive(eprosima::fastdds::rtps::TransportReceiverInterface* next, const eprosima::fastrtps::rtps::octet* bytes,
               std::uint32_t size, const eprosima::fastrtps::rtps::Locator_t& local,
               const eprosima::fastrtps::rtps::Locator_t& remote) override;

protected:
  // Leaves those without an address out at the begin; false if nobody is left.
  static bool HasDestination(eprosima::fastrtps::rtps::LocatorsIterator& first,
                             const eprosima::fastrtps::rtps::LocatorsIterator& last);
  // Returns the part of a datagram that Fast DDS may read. It is empty if the datagram was refused; the listener is
  // told.
  std::span<const char> Read(std::span<const char> datagram, const RtpsLimits& limits,
                             const eprosima::fastrtps::rtps::Locator_t& remote) const;
  void TellMalformed(const std::string& what, const eprosima::fastrtps::rtps::Locator_t& remote) const;
  static void Pass(eprosima::fastdds::rtps::TransportReceiverInterface* next, std::span<const char> datagram,
                   const eprosima::fastrtps::rtps::Locator_t& local, const eprosima::fastrtps::rtps::Locator_t& remote);

private:
  DiscardingTransportDescriptor descriptor_;
};

}  // namespace swarmanoid
