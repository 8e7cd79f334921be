// The transport of the bus: it reports datagrams that CheckRtps refuses, discards messages to readers without an
// address, and leaves out what DiscoveryPace says.
//
// A reader that shares memory has no address. Its memory cannot be opened if its process has just ended. Then Fast DDS
// (2.9) writes to it over the network, and tries for ever to send the fragments of a message that has no destination.
// (StatefulWriter::deliver_sample_to_network goes on only after a fragment was sent.)
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "common/bus/dds/filter_transport.h"
#include "common/bus/security/datagram_signatures.h"
#include "common/bus/security/discovery_pace.h"

namespace swarmanoid
{

// The address of endpoints that receive nothing over the network. No transport here uses its kind.
rtps::Locator_t NowhereLocator();

// Threads of the transport call these functions. The functions are empty once the bus is destroyed, because a
// participant may live until the program ends.
struct DatagramListener
{
  // Guards both functions.
  std::mutex mutex;
  // Reports a dropped datagram: its defect and the address that it came from.
  std::function<void(const std::string& what, const std::string& address)> malformed;
  // Reports the process that a stranger impersonated, and the address and port of the stranger.
  std::function<void(const GuidPrefix& member, const std::string& sender)> forged;
};

struct DiscardingTransportDescriptor : transport::ChainingTransportDescriptor
{
  DiscardingTransportDescriptor(std::shared_ptr<transport::TransportDescriptorInterface> udp, bool over_a_network,
                                std::shared_ptr<DatagramListener> its_listener)
      : ChainingTransportDescriptor(std::move(udp)), spreads(over_a_network), listener(std::move(its_listener))
  {
  }

  transport::TransportInterface* create_transport() const override;
  std::uint32_t max_message_size() const override { return maxMessageSize; }

  const bool spreads;  // the run is on several machines
  const std::shared_ptr<DatagramListener> listener;
};

class DiscardingTransport : public FilterTransport
{
public:
  explicit DiscardingTransport(const DiscardingTransportDescriptor& descriptor);

  transport::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }
  void select_locators(rtps::LocatorSelector& selector) const override;
  bool Send(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first, rtps::LocatorsIterator& last,
            const Deadline& deadline) final;
  void Refuse(const std::string& what, const rtps::Locator_t& remote) override;

protected:
  // Writes a datagram to its destinations.
  virtual bool Write(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first, rtps::LocatorsIterator& last,
                     const Deadline& deadline)
  {
    return SendDatagram(socket, datagram, first, last, deadline);
  }

private:
  DiscardingTransportDescriptor descriptor_;
  std::mutex mutex_;    // guards the next one
  DiscoveryPace pace_;  // of this process
};

}  // namespace swarmanoid
