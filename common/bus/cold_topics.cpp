#include <algorithm>

#include "common/bus/cold_types.h"
#include "common/bus/participant.h"

namespace swarmanoid
{

namespace
{

constexpr std::uint32_t kFirstRoom = 1024;  // bytes; grows with the messages

template <class Message>
dds::Topic* ColdTopic(Bus& bus)
{
  using Traits = ColdTraits<Message>;
  const auto make_type = []
  {
    auto* type = new typename Traits::Support();
    // Room is made for a message of the largest size otherwise: gigabytes for the insides of robots.
    type->m_typeSize = std::min<std::uint32_t>(type->m_typeSize, kFirstRoom);
    return dds::TypeSupport(type);
  };
  return bus.Internals().TopicOf(Traits::kTopic, make_type);
}

}  // namespace

template <class Message>
struct Publisher<Message>::Impl
{
  Impl(Bus& bus, const std::string& partition)
      : writer(bus, ColdTopic<Message>(bus), partition, WriterQos(QosOf(ColdTraits<Message>::kTopic)))
  {
  }

  WriterEnd writer;
  std::mutex mutex;
  typename ColdTraits<Message>::Wire wire;
};

template <class Message>
Publisher<Message>::Publisher(Bus& bus, const std::string& partition) : impl_(std::make_unique<Impl>(bus, partition))
{
}

template <class Message>
Publisher<Message>::~Publisher() = default;

template <class Message>
void Publisher<Message>::Write(const Message& message)
{
  const std::lock_guard lock(impl_->mutex);
  ToWire(message, impl_->wire);
  if (!impl_->writer->write(&impl_->wire)) throw BusError(std::string("cannot send ") + ColdTraits<Message>::kTopic);
}

template <class Message>
unsigned Publisher<Message>::Readers() const
{
  return impl_->writer.Matched();
}

template <class Message>
bool Publisher<Message>::WaitUntilRead(double seconds)
{
  const auto nanoseconds = static_cast<std::uint32_t>((seconds - static_cast<int>(seconds)) * 1e9);
  return impl_->writer->wait_for_acknowledgments({static_cast<int>(seconds), nanoseconds}) == ReturnCode::RETCODE_OK;
}

template <class Message>
struct Subscription<Message>::Impl : dds::DataReaderListener
{
  Impl(Bus& bus, const std::string& partition, std::function<void(const Message&)> callback)
      : received(std::move(callback)),
        reader(bus, ColdTopic<Message>(bus), partition, ReaderQos(QosOf(ColdTraits<Message>::kTopic), 1), this)
  {
  }

  void on_data_available(dds::DataReader* source) override
  {
    const std::lock_guard lock(mutex);
    dds::SampleInfo about;
    while (source->take_next_sample(&wire, &about) == ReturnCode::RETCODE_OK)
    {
      if (!about.valid_data) continue;
      FromWire(wire, message);
      received(message);
    }
  }

  std::function<void(const Message&)> received;
  std::mutex mutex;
  typename ColdTraits<Message>::Wire wire;
  Message message;
  ReaderEnd reader;
};

template <class Message>
Subscription<Message>::Subscription(Bus& bus, const std::string& partition,
                                    std::function<void(const Message&)> received)
    : impl_(std::make_unique<Impl>(bus, partition, std::move(received)))
{
}

template <class Message>
Subscription<Message>::~Subscription() = default;

template <class Message>
unsigned Subscription<Message>::Writers() const
{
  return impl_->reader.Matched();
}

#define SWARMANOID_INSTANTIATE(MESSAGE) \
  template class Publisher<MESSAGE>;    \
  template class Subscription<MESSAGE>;
SWARMANOID_INSTANTIATE(WorldMessage)
SWARMANOID_INSTANTIATE(HelloMessage)
SWARMANOID_INSTANTIATE(ViewMessage)
SWARMANOID_INSTANTIATE(ControlRequestMessage)
SWARMANOID_INSTANTIATE(ControlReplyMessage)
SWARMANOID_INSTANTIATE(StatusMessage)
SWARMANOID_INSTANTIATE(SavedStateMessage)
SWARMANOID_INSTANTIATE(WishesMessage)
SWARMANOID_INSTANTIATE(RunStatusMessage)
SWARMANOID_INSTANTIATE(RobotStatusMessage)
SWARMANOID_INSTANTIATE(ByeMessage)
#undef SWARMANOID_INSTANTIATE

}  // namespace swarmanoid
