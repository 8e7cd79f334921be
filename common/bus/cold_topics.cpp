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

constexpr const char* kNoSeal =
    "it is not sealed by the key of this run: its sender is of another user or another run, or was started without "
    "the key (--key)";

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
  Impl(Bus& its_bus, const std::string& its_partition)
      : bus(its_bus.Internals()),
        partition(its_partition),
        writer(its_bus, ColdTopic<Message>(its_bus), partition, WriterQos(QosOf(kTopicOf<Message>)))
  {
  }

  Bus::Impl& bus;
  const std::string partition;
  WriterEnd writer;
  std::mutex mutex;
  std::uint64_t number = 0;  // of the last message
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
  const auto key = impl_->bus.insecure ? std::nullopt : impl_->bus.keys.Of(impl_->partition);
  if (key)
    call.seal = [&](std::span<char> payload)
    { Seal(payload, *key, kTopicOf<Message>, IdOf(impl_->writer->guid()), ++impl_->number); };
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
  using Writer = eprosima::fastrtps::rtps::GUID_t;

  Impl(Bus& its_bus, const std::string& its_partition, std::function<void(const Message&)> callback)
      : bus(its_bus.Internals()),
        partition(its_partition),
        received(std::move(callback)),
        reader(its_bus, ColdTopic<Message>(its_bus), partition, ReaderQos(QosOf(kTopicOf<Message>), 1), this)
  {
  }

  void on_data_available(dds::DataReader* source) override
  {
    const std::lock_guard lock(mutex);
    ColdCall<Message> call;
    call.payload = &payload;
    dds::SampleInfo about;
    while (source->take_next_sample(&call, &about) == ReturnCode::RETCODE_OK)
      if (about.valid_data) Take(about.sample_identity.writer_guid());
  }

  void Take(const Writer& writer)
  {
    // Nothing of a message is looked at before it is known whose it is.
    std::optional<std::uint64_t> number;
    if (!bus.insecure)
    {
      number = bus.keys.Open(partition, payload, kTopicOf<Message>, IdOf(writer));
      if (!number) return bus.Refuse(kTopicOf<Message>, writer, kNoSeal);
      bus.Recognise(writer);
    }
    try
    {
      ReadPayload(std::span<const char>(payload), message);
      if (number && !IsNew(writer, *number))
        return bus.Refuse(kTopicOf<Message>, writer, "it is a repetition of a message that has come before");
      received(message);
    }
    catch (const BadMessage& error)
    {
      bus.Report(kTopicOf<Message>, writer, TickOf(message), error.what());
    }
  }

  // Those of one writer come in their order; of topics with instances, those of one instance.
  bool IsNew(const Writer& writer, std::uint64_t number)
  {
    const std::string* const instance = KeyOf(message);
    std::uint64_t& last = numbers[{IdOf(writer), instance == nullptr ? std::string() : *instance}];
    if (number <= last) return false;
    last = number;
    return true;
  }

  Bus::Impl& bus;
  const std::string partition;
  std::function<void(const Message&)> received;
  std::mutex mutex;
  std::vector<char> payload;
  Message message;
  std::map<std::pair<WriterId, std::string>, std::uint64_t> numbers;  // of the last message
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
