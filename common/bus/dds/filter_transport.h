// A transport of Fast DDS that stands between it and UDP, and sees each datagram that goes or comes, with one set of
// functions for all releases.
#pragma once

#include "common/bus/dds/fast_dds.h"
#if SWARMANOID_FAST_DDS_MAJOR >= 3
#include <fastdds/rtps/common/LocatorSelector.hpp>
#include <fastdds/rtps/common/LocatorsIterator.hpp>
#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.hpp>
#include <fastdds/rtps/transport/SenderResource.hpp>
#include <fastdds/rtps/transport/TransportReceiverInterface.hpp>
#else
#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/common/LocatorList.hpp>
#endif

#include <span>
#include <vector>

namespace swarmanoid
{

using Deadline = std::chrono::steady_clock::time_point;

// The socket that a datagram goes out by.
using Socket = rtps::SenderResource;

// Sends one datagram. Advances `first` to `last`. Returns false if it could not be sent before the deadline.
inline bool SendDatagram(Socket& socket, std::span<const rtps::octet> datagram, rtps::LocatorsIterator& first,
                         rtps::LocatorsIterator& last, const Deadline& deadline)
{
  const auto size = static_cast<std::uint32_t>(datagram.size());
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return socket.send({transport::NetworkBuffer(datagram.data(), size)}, size, &first, &last, deadline);
#else
  return socket.send(datagram.data(), size, &first, &last, deadline);
#endif
}

class FilterTransport : public transport::ChainingTransport
{
public:
  using ChainingTransport::ChainingTransport;

  // Called for each datagram that Fast DDS wants to send, in the thread that writes. The bytes are gone after the call.
  virtual bool Send(Socket& socket, std::span<const rtps::octet> datagram, rtps::LocatorsIterator& first,
                    rtps::LocatorsIterator& last, const Deadline& deadline) = 0;
  // Called for each datagram that comes, in a thread of the transport. What Fast DDS shall read goes to
  // `next.OnDataReceived`.
  virtual void Receive(transport::TransportReceiverInterface& next, std::span<const rtps::octet> datagram,
                       const rtps::Locator_t& local, const rtps::Locator_t& remote)
  {
    next.OnDataReceived(datagram.data(), static_cast<std::uint32_t>(datagram.size()), local, remote);
  }

  void receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& local, const rtps::Locator_t& remote) final
  {
    Receive(*next, {bytes, size}, local, remote);
  }

#if SWARMANOID_FAST_DDS_MAJOR >= 3
  // Fast DDS gives a datagram in pieces: they are put together, as one copy of some kilobytes is cheaper than what the
  // kernel does for each.
  bool send(Socket* socket, const std::vector<transport::NetworkBuffer>& pieces, std::uint32_t size,
            rtps::LocatorsIterator* first, rtps::LocatorsIterator* last, const Deadline& deadline) final
  {
    if (pieces.size() == 1)
      return Send(*socket, {static_cast<const rtps::octet*>(pieces[0].buffer), size}, *first, *last, deadline);
    thread_local std::vector<rtps::octet> datagram;
    datagram.clear();
    for (const transport::NetworkBuffer& piece : pieces)
    {
      const auto* const bytes = static_cast<const rtps::octet*>(piece.buffer);
      datagram.insert(datagram.end(), bytes, bytes + piece.size);
    }
    return Send(*socket, datagram, *first, *last, deadline);
  }
#else
  bool send(Socket* socket, const rtps::octet* bytes, std::uint32_t size, rtps::LocatorsIterator* first,
            rtps::LocatorsIterator* last, const Deadline& deadline) final
  {
    return Send(*socket, {bytes, size}, *first, *last, deadline);
  }
#endif
};

}  // namespace swarmanoid
