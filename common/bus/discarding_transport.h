// A transport of Fast DDS in which messages to readers without an address are discarded.
//
// A reader that shares memory has no address. If its memory cannot be opened, since its process has just ended, Fast
// DDS (2.9) writes to it over the network, and tries for ever to send the fragments of a message that has no
// destination (StatefulWriter::deliver_sample_to_network goes on only once a fragment was sent to somebody).
#pragma once

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>

namespace swarmanoid
{

// The address of endpoints that hear nobody over the network: of a kind that no transport here speaks.
eprosima::fastrtps::rtps::Locator_t NowhereLocator();

struct DiscardingTransportDescriptor : eprosima::fastdds::rtps::ChainingTransportDescriptor
{
  using ChainingTransportDescriptor::ChainingTransportDescriptor;

  eprosima::fastdds::rtps::TransportInterface* create_transport() const override;
  std::uint32_t max_message_size() const override { return maxMessageSize; }
};

class DiscardingTransport : public eprosima::fastdds::rtps::ChainingTransport
{
public:
  explicit DiscardingTransport(const DiscardingTransportDescriptor& descriptor);

  eprosima::fastdds::rtps::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }
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

private:
  DiscardingTransportDescriptor descriptor_;
};

}  // namespace swarmanoid
