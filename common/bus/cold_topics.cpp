#include "common/bus/message_type.h"
#include "common/bus/participant.h"

namespace swarmanoid
{

namespace
{

template <class Message>
dds::Topic* ColdTopic(Bus& bus)
{
  return bus.Internals().TopicOf(kTopicOf<Message>, [] { return dds::TypeSupport(new ColdType<Message>()); });
}

template <class Message>
std::uint64_t TickOf(const Message& message)
{
  if constexpr (requires { message.tick; })
    return message.tick;
  else
    return 0;
}

}  // namespace

template <class Message>
struct Publisher<Message>::Impl
{
  Impl(Bus& bus, const std::string& partition)
      : writer(bus, ColdTopic<Message>(bus), partition, WriterQos(QosOf(kTopicOf<Message>)))
  {
  }

  WriterEnd writer;
  std::mutex mutex;
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
  ColdCall<Message> call;
  call.out = &message;
  try
  {
    call.size = PayloadSize(message);
  }
  catch (const BadMessage& error)
  {
    throw BadMessage(std::string("cannot send ") + kTopicOf<Message> + ": " + error.what());
  }
  const std::lock_guard lock(impl_->mutex);
  if (!impl_->writer->write(&call)) throw BusError(std::string("cannot send ") + kTopicOf<Message>);
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
  Impl(Bus& its_bus, const std::string& partition, std::function<void(const Message&)> callback)
      : bus(its_bus),
        received(std::move(callback)),
        reader(bus, ColdTopic<Message>(bus), partition, ReaderQos(QosOf(kTopicOf<Message>), 1), this)
  {
  }

  void on_data_available(dds::DataReader* source) override
  {
    const std::lock_guard lock(mutex);
    ColdCall<Message> call;
    call.in = &message;
    dds::SampleInfo about;
    while (source->take_next_sample(&call, &about) == ReturnCode::RETCODE_OK)
    {
      if (!about.valid_data) continue;
      try
      {
        if (call.error.empty()) received(message);
      }
      catch (const BadMessage& error)
      {
        call.error = error.what();
      }
      if (!call.error.empty())
        bus.Internals().Report(kTopicOf<Message>, about.sample_identity.writer_guid(), TickOf(message), call.error);
    }
  }

  Bus& bus;
  std::function<void(const Message&)> received;
  std::mutex mutex;
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
SWARMANOID_INSTANTIATE(JoinMessage)
SWARMANOID_INSTANTIATE(ViewMessage)
SWARMANOID_INSTANTIATE(ControlRequestMessage)
SWARMANOID_INSTANTIATE(ControlReplyMessage)
SWARMANOID_INSTANTIATE(StatusMessage)
SWARMANOID_INSTANTIATE(SavedStateMessage)
SWARMANOID_INSTANTIATE(RecoveryRequestMessage)
SWARMANOID_INSTANTIATE(RecoveryBlockMessage)
SWARMANOID_INSTANTIATE(ViewRequestMessage)
SWARMANOID_INSTANTIATE(RunStatusMessage)
SWARMANOID_INSTANTIATE(RobotStatusMessage)
SWARMANOID_INSTANTIATE(LeaveMessage)
#undef SWARMANOID_INSTANTIATE

}  // namespace swarmanoid
