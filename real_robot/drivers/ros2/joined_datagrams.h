// Joins several messages of DDS into one datagram. A process that publishes for a hundred robots at once sends hundreds
// of small messages to the same listener, and a datagram costs more than its content. RTPS allows it: the submessages
// behind the header of a datagram may come from different writers (DDSI-RTPS 2.2, 8.3.3). The participant of
// ros2_endpoints.cpp has the transport; publishers for many robots use the class.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "common/bus/dds/filter_transport.h"

namespace swarmanoid::ros2
{

// While an object lives, the messages that its thread writes wait. At its end they are sent in few datagrams. Keep it
// only for messages that are written together, since listeners wait, too.
class JoinedDatagrams
{
public:
  JoinedDatagrams();
  ~JoinedDatagrams();
  JoinedDatagrams(const JoinedDatagrams&) = delete;
  JoinedDatagrams& operator=(const JoinedDatagrams&) = delete;
};

// Appends the content of `next`, of the same participant, to `datagram` if the result has at most so many bytes.
// Returns false and changes nothing if they cannot be joined.
bool Join(std::vector<unsigned char>& datagram, std::span<const unsigned char> next, std::size_t most_bytes);

// Returns a UDP transport that joins messages for participants.
std::shared_ptr<transport::TransportDescriptorInterface> JoiningTransport(
    std::shared_ptr<transport::TransportDescriptorInterface> udp);

}  // namespace swarmanoid::ros2
