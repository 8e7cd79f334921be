// UDP whose datagrams are signed and checked by DatagramSignatures, as a transport of Fast DDS.
#pragma once

#include <memory>

#include "common/bus/security/datagram_signatures.h"
#include "common/bus/security/discarding_transport.h"

namespace swarmanoid
{

struct SignedTransportDescriptor : DiscardingTransportDescriptor
{
  SignedTransportDescriptor(std::shared_ptr<transport::TransportDescriptorInterface> udp, bool over_a_network,
                            std::shared_ptr<DatagramSignatures> its_signatures,
                            std::shared_ptr<DatagramListener> its_listener);

  transport::TransportInterface* create_transport() const override;

  const std::shared_ptr<DatagramSignatures> signatures;
};

}  // namespace swarmanoid
