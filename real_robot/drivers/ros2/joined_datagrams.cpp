// The transport of this file stands between DDS and its UDP transport. While a JoinedDatagrams exists in a thread, its
// datagrams wait, and each new one is appended to the latest waiting one for the same destination and socket. Appending
// is allowed if both have the same header (one participant), each submessage states its length, and the result still
// fits.
//
// Two things must hold for a datagram behind another one: a receiver must not apply the time stamp or the destination
// of the submessages in front to it, so neutral ones are put between them; and the submessage with which Fast DDS ends
// a datagram must stay the last one. Anything that does not match is sent alone.
#include "real_robot/drivers/ros2/joined_datagrams.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "common/logging/log.h"

namespace swarmanoid::ros2
{
namespace
{

using Byte = unsigned char;

constexpr std::size_t kHeaderBytes = 20;
constexpr Byte kPad = 0x01;
constexpr Byte kTimestamp = 0x09;
// The submessages in front of the joined ones: no time stamp, and no particular destination. The joined submessages
// state their own.
constexpr std::array<Byte, 20> kAsAtTheFront{kTimestamp, 0x03, 0, 0, 0x0e, 0x01, 12, 0};
// Fast DDS ends each datagram with this submessage about the network. It must stay the last one.
constexpr std::array<Byte, 4> kStatistics{0x80, 0x01, 56, 0};
constexpr std::size_t kStatisticsBytes = 60;

// On the loopback a datagram stays whole, so it may fill the readers' buffers. Elsewhere it must fit into an Ethernet
// frame.
constexpr std::size_t kMostOnLoopback = 16'000;
constexpr std::size_t kMostInFrame = 1'400;

std::size_t StatisticsAtEnd(std::span<const Byte> datagram)
{
  if (datagram.size() < kHeaderBytes + kStatisticsBytes) return 0;
  return std::ranges::equal(datagram.last(kStatisticsBytes).first(kStatistics.size()), kStatistics) ? kStatisticsBytes
                                                                                                    : 0;
}

// Returns whether each submessage states where the next one begins, so that another may follow the last.
bool EndsWhereItSays(std::span<const Byte> submessages)
{
  while (submessages.size() >= 4)
  {
    const bool is_little_endian = (submessages[1] & 1U) != 0;
    const std::size_t length =
        is_little_endian ? submessages[2] | submessages[3] << 8 : submessages[3] | submessages[2] << 8;
    if (length == 0 && submessages[0] != kPad && submessages[0] != kTimestamp) return false;
    if (length % 4 != 0 || 4 + length > submessages.size()) return false;
    submessages = submessages.subspan(4 + length);
  }
  return submessages.empty();
}

// A waiting datagram with its destination and socket.
struct Waiting
{
  Socket* below;
  std::vector<rtps::Locator_t> locators;
  std::vector<Byte> bytes;
  std::size_t most_bytes;

  bool Send(const Deadline& deadline) const
  {
    rtps::Locators first(locators.begin()), last(locators.end());
    return SendDatagram(*below, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, first, last, deadline);
  }
};

struct Collection
{
  int depth = 0;
  std::vector<Waiting> waiting;
};
Collection& OfThisThread()
{
  thread_local Collection collection;
  return collection;
}

class Joining : public FilterTransport
{
public:
  explicit Joining(const transport::ChainingTransportDescriptor& descriptor);
  transport::TransportDescriptorInterface* get_configuration() override { return configuration_.get(); }

  bool Send(Socket& socket, Datagram datagram, rtps::LocatorsIterator& first, rtps::LocatorsIterator& last,
            const Deadline& deadline) override
  {
    Collection& collection = OfThisThread();
    if (collection.depth == 0) return SendDatagram(socket, datagram, first, last, deadline);
    std::vector<rtps::Locator_t> locators;
    for (; first != last; ++first) locators.push_back(*first);
    if (locators.empty()) return true;
    // The latest datagram to the same destination is the one with space.
    const auto open =
        std::find_if(collection.waiting.rbegin(), collection.waiting.rend(),
                     [&](const Waiting& waiting) { return waiting.below == &socket && waiting.locators == locators; });
    const std::span<const Byte> bytes(reinterpret_cast<const Byte*>(datagram.data()), datagram.size());
    if (open != collection.waiting.rend() && Join(open->bytes, bytes, open->most_bytes)) return true;
    const bool stays_here =
        std::ranges::all_of(locators, [](const rtps::Locator_t& to) { return rtps::IPLocator::isLocal(to); });
    collection.waiting.push_back(
        {&socket, std::move(locators), {bytes.begin(), bytes.end()}, stays_here ? kMostOnLoopback : kMostInFrame});
    return true;
  }

  void Refuse(const std::string& what, const rtps::Locator_t& remote) override
  {
    if (!refused_.exchange(true))
      LogWarning("dropped a bad datagram of {}: {}; further ones are dropped without a word",
                 rtps::IPLocator::toIPv4string(remote), what);
  }

private:
  std::unique_ptr<transport::ChainingTransportDescriptor> configuration_;
  std::atomic<bool> refused_ = false;
};

struct Descriptor : transport::ChainingTransportDescriptor
{
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  transport::TransportInterface* create_transport() const override { return new Joining(*this); }
  std::uint32_t max_message_size() const override { return maxMessageSize; }
};

Joining::Joining(const transport::ChainingTransportDescriptor& descriptor)
    : FilterTransport(descriptor),
      configuration_(std::make_unique<Descriptor>(static_cast<const Descriptor&>(descriptor)))
{
}

}  // namespace

bool Join(std::vector<unsigned char>& datagram, std::span<const unsigned char> next, std::size_t most_bytes)
{
  if (datagram.size() < kHeaderBytes || next.size() < kHeaderBytes) return false;
  if (!std::equal(next.begin(), next.begin() + kHeaderBytes, datagram.begin())) return false;
  const std::size_t at_end = StatisticsAtEnd(datagram);
  if (StatisticsAtEnd(next) != at_end) return false;
  const auto added = next.subspan(kHeaderBytes, next.size() - kHeaderBytes - at_end);
  if (datagram.size() + kAsAtTheFront.size() + added.size() > most_bytes) return false;
  const std::span<const Byte> before = std::span<const Byte>(datagram).first(datagram.size() - at_end);
  if (!EndsWhereItSays(before.subspan(kHeaderBytes)) || !EndsWhereItSays(added)) return false;
  const auto end =
      datagram.insert(datagram.end() - static_cast<std::ptrdiff_t>(at_end), kAsAtTheFront.begin(), kAsAtTheFront.end());
  datagram.insert(end + kAsAtTheFront.size(), added.begin(), added.end());
  return true;
}

JoinedDatagrams::JoinedDatagrams() { ++OfThisThread().depth; }

JoinedDatagrams::~JoinedDatagrams()
{
  Collection& collection = OfThisThread();
  if (--collection.depth > 0) return;
  const Deadline deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
  for (const Waiting& waiting : collection.waiting) waiting.Send(deadline);
  collection.waiting.clear();
}

std::shared_ptr<transport::TransportDescriptorInterface> JoiningTransport(
    std::shared_ptr<transport::TransportDescriptorInterface> udp)
{
  return std::make_shared<Descriptor>(std::move(udp));
}

}  // namespace swarmanoid::ros2
