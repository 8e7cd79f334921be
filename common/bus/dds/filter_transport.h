// A transport of Fast DDS that stands between it and UDP, and sees each datagram that goes or comes, with one set of
// functions for all releases. Datagrams that CheckRtps refuses never reach Fast DDS.
#pragma once

#include "common/bus/dds/check_rtps.h"
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

#include <algorithm>
#include <chrono>
#include <span>
#include <string>
#include <vector>

namespace swarmanoid
{

using Deadline = std::chrono::steady_clock::time_point;
using Datagram = std::span<const char>;

// The socket that sends a datagram.
using Socket = rtps::SenderResource;

// Sends one datagram. Advances `first` to `last`. Returns false if it could not be sent before the deadline.
inline bool SendDatagram(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first, rtps::LocatorsIterator& last,
                         const Deadline& deadline)
{
  const auto* const bytes = reinterpret_cast<const rtps::octet*>(datagram.data());
  const auto size = static_cast<std::uint32_t>(datagram.size());
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return socket.send({transport::NetworkBuffer(bytes, size)}, size, &first, &last, deadline);
#else
  return socket.send(bytes, size, &first, &last, deadline);
#endif
}

class FilterTransport : public transport::ChainingTransport
{
public:
  using ChainingTransport::ChainingTransport;

  // Fast DDS calls it for each datagram that it wants to send, in the thread that writes. The bytes are gone after the
  // call.
  virtual bool Send(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first, rtps::LocatorsIterator& last,
                    const Deadline& deadline) = 0;
  // The transport calls it in its thread for each received datagram with a valid RTPS structure. Pass hands the
  // datagram to Fast DDS.
  virtual void Receive(transport::TransportReceiverInterface& next, Datagram datagram, const rtps::Locator_t& local,
                       const rtps::Locator_t& remote)
  {
    Pass(next, datagram, local, remote);
  }
  // The transport calls it in its thread for each datagram that it drops because of its structure.
  virtual void Refuse(const std::string& what, const rtps::Locator_t& remote) = 0;

  bool OpenInputChannel(const rtps::Locator_t& locator, transport::TransportReceiverInterface* receiver,
                        std::uint32_t max_message_size) override
  {
    return ChainingTransport::OpenInputChannel(locator, receiver, std::max(max_message_size, kRoomForDatagrams));
  }

  void receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& local, const rtps::Locator_t& remote) final
  {
    const Datagram datagram = Check({reinterpret_cast<const char*>(bytes), size}, kMemberLimits, remote);
    if (!datagram.empty()) Receive(*next, datagram, local, remote);
  }

#if SWARMANOID_FAST_DDS_MAJOR >= 3
  // Fast DDS gives a datagram in pieces. They are put together, as one copy of some kilobytes is cheaper than what the
  // kernel does for each piece.
  bool send(Socket* socket, const std::vector<transport::NetworkBuffer>& pieces, std::uint32_t size,
            rtps::LocatorsIterator* first, rtps::LocatorsIterator* last, const Deadline& deadline) final
  {
    if (pieces.size() == 1)
      return Send(*socket, {static_cast<const char*>(pieces[0].buffer), size}, *first, *last, deadline);
    thread_local std::vector<char> datagram;
    datagram.clear();
    for (const transport::NetworkBuffer& piece : pieces)
    {
      const auto* const bytes = static_cast<const char*>(piece.buffer);
      datagram.insert(datagram.end(), bytes, bytes + piece.size);
    }
    return Send(*socket, datagram, *first, *last, deadline);
  }
#else
  bool send(Socket* socket, const rtps::octet* bytes, std::uint32_t size, rtps::LocatorsIterator* first,
            rtps::LocatorsIterator* last, const Deadline& deadline) final
  {
    return Send(*socket, {reinterpret_cast<const char*>(bytes), size}, *first, *last, deadline);
  }
#endif

protected:
  // Returns the part of a datagram that Fast DDS may read. It is empty if the datagram was refused.
  Datagram Check(Datagram datagram, const RtpsLimits& limits, const rtps::Locator_t& remote)
  {
    const RtpsVerdict verdict = CheckRtps(datagram, limits);
    if (verdict.defect == nullptr) return datagram.first(verdict.bytes);
    Refuse(std::string(verdict.defect) + ", at byte " + std::to_string(verdict.bytes) + " of " +
               std::to_string(datagram.size()),
           remote);
    return {};
  }

  static void Pass(transport::TransportReceiverInterface& next, Datagram datagram, const rtps::Locator_t& local,
                   const rtps::Locator_t& remote)
  {
    next.OnDataReceived(reinterpret_cast<const rtps::octet*>(datagram.data()),
                        static_cast<std::uint32_t>(datagram.size()), local, remote);
  }

private:
  // A reader of Fast DDS may have begun to put a message together. Then it copies as many bytes as the last fragment of
  // that message has, even if the datagram that ends it has fewer. Fragments have less than 64 KiB, and so has the
  // datagram before them. The room behind it is never filled, and a message with bytes from there is dropped as
  // damaged.
  static constexpr std::uint32_t kRoomForDatagrams = 128U * 1024U;
};

}  // namespace swarmanoid
