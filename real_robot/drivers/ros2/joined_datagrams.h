// Several messages of DDS in one datagram: a process that publishes for a hundred robots at once sends hundreds of
// small ones to the same listener, and a datagram costs more than what is in it. RTPS allows it: behind the header of a
// datagram its submessages follow one another, whichever writers they are of (DDSI-RTPS 2.2, 8.3.3). Used by
// ros2_endpoints.cpp, whose participant has the transport, and by those who publish for many.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "common/bus/dds/filter_transport.h"

namespace swarmanoid::ros2
{

// While one lives, what its thread writes waits, and goes out as few datagrams at its end. No longer than what is
// written at once: who listens waits, too.
class JoinedDatagrams
{
public:
  JoinedDatagrams();
  ~JoinedDatagrams();
  JoinedDatagrams(const JoinedDatagrams&) = delete;
  JoinedDatagrams& operator=(const JoinedDatagrams&) = delete;
};

// `datagram` grows by what is in `next`, of the same participant, if both can be joined within so many bytes; false,
// and nothing happens, if they cannot.
bool Join(std::vector<unsigned char>& datagram, std::span<const unsigned char> next, std::size_t most_bytes);

// UDP that does so for participants.
std::shared_ptr<transport::TransportDescriptorInterface> JoiningTransport(
    std::shared_ptr<transport::TransportDescriptorInterface> udp);

}  // namespace swarmanoid::ros2
