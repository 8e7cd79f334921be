// UDP whose datagrams are signed and checked by DatagramSignatures, as a transport of Fast DDS.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "common/bus/datagram_signatures.h"
#include "common/bus/discarding_transport.h"

namespace swarmanoid
{

struct SignedTransportDescriptor : DiscardingTransportDescriptor
{
  // Called in threads of the transport.
  struct Listener
  {
    std::mutex mutex;
    // A process in whose name somebody spoke, and the address and port of whoever sent that. Nobody once the bus goes:
    // a participant may outlive it until the program ends.
    std::function<void(const GuidPrefix& member, const std::string& sender)> forged;
  };

  SignedTransportDescriptor(std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp,
                            std::shared_ptr<DatagramSignatures> its_signatures, std::shared_ptr<Listener> its_listener);

  eprosima::fastdds::rtps::TransportInterface* create_transport() const override;

  const std::shared_ptr<DatagramSignatures> signatures;
  const std::shared_ptr<Listener> listener;
};

}  // namespace swarmanoid
