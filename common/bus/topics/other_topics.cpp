#include <fmt/format.h>

#include <utility>

#include "common/bus/topics/message_type.h"
#include "common/bus/topics/participant.h"

namespace swarmanoid
{

namespace
{

// ReusedMemory up to this size (bytes) is kept. Worlds come once, and may be a hundred times as large.
constexpr std::size_t kKept = 1 << 20;

// The topics of a grant have their own name, so that members' readers do not receive messages that they cannot open.
template <class Message>
std::string TopicName(const std::optional<GrantChannel>& grant)
{
  return grant ? std::string(kTopicOf<Message>) + "/" + grant->id : kTopicOf<Message>;
}

template <class Message>
dds::Topic* ColdTopic(Bus& bus, const std::string& name)
{
  return bus.Internals().TopicOf(name, [] { return dds::TypeSupport(new ColdType<Message>()); });
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
  Impl(Bus& its_bus, const std::string& its_partition, const std::optional<GrantChannel>& its_grant)
      : bus(its_bus.Internals()),
        partition(its_partition),
        grant(its_grant ? its_grant : bus.grant),
        topic(TopicName<Message>(grant)),
        writer(its_bus, ColdTopic<Message>(its_bus, topic), partition,
               WriterQos(QosOf(kTopicOf<Message>), its_bus.Internals().spreads))
  {
  }

  // Uses the current key of the run; nullptr if every process is let in.
  Sealer* SealerNow()
  {
    if (bus.insecure || (grant && !grant->key)) return nullptr;
    const auto key = grant ? grant->key : bus.keys.Of(partition);
    if (!key)
      throw BusError(fmt::format("cannot send {}: this process has no key of the run of '{}'", topic, partition));
    if (!sealer || sealer->Key() != *key) sealer.emplace(*key, topic);
    return &*sealer;
  }

  Bus::Impl& bus;
  const std::string partition;
  const std::optional<GrantChannel> grant;
  const std::string topic;
  WriterEnd writer;
  std::mutex mutex;
  std::optional<Sealer> sealer;
};

template <class Message>
Publisher<Message>::Publisher(Bus& bus, const std::string& partition, const std::optional<GrantChannel>& grant)
    : impl_(std::make_unique<Impl>(bus, partition, grant))
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
  call.sealer = impl_->SealerNow();
  call.writer = IdOf(impl_->writer->guid());
  if (!impl_->writer.Write(&call)) throw BusError(std::string("cannot send ") + kTopicOf<Message>);
}

template <class Message>
void Publisher<Message>::Forget()
{
  std::size_t forgotten = 0;
  if (!Succeeded(impl_->writer->clear_history(&forgotten)))
    throw BusError(std::string("cannot forget messages of ") + kTopicOf<Message>);
}

template <class Message>
unsigned Publisher<Message>::Readers() const
{
  return impl_->writer.Matched();
}

template <class Message>
bool Publisher<Message>::WaitUntilRead(double seconds)
{
  return Succeeded(impl_->writer->wait_for_acknowledgments(Seconds(seconds)));
}

template <class Message>
struct Subscription<Message>::Impl : dds::DataReaderListener
{
  using Writer = rtps::GUID_t;

  Impl(Bus& its_bus, const std::string& its_partition, std::function<void(const Message&)> callback,
       const std::optional<GrantChannel>& its_grant)
      : bus(its_bus.Internals()),
        partition(its_partition),
        grant(its_grant ? its_grant : bus.grant),
        topic(TopicName<Message>(grant)),
        received(std::move(callback)),
        opener(topic),
        reader(its_bus,
               [this, &its_bus]
               {
                 return std::make_unique<ReaderEnd>(its_bus, ColdTopic<Message>(its_bus, topic), partition,
                                                    ReaderQos(QosOf(kTopicOf<Message>), 1), this);
               })
  {
  }

  void on_data_available(dds::DataReader* source) override
  {
    const std::lock_guard lock(mutex);
    ColdCall<Message> call;
    call.payload = &payload;
    dds::SampleInfo about;
    while (Succeeded(source->take_next_sample(&call, &about)))
    {
      if (about.valid_data) Take(about.sample_identity.writer_guid());
      if (payload.capacity() > kKept) GiveRoomBack();
    }
  }

  void GiveRoomBack()
  {
    std::exchange(payload, {});
    std::exchange(room, {});
    message = {};
  }

  void Take(const Writer& writer)
  {
    std::optional<Opener::Opened> opened;
    std::span<const char> bytes = payload;
    try
    {
      // The seal of a message is checked before its fields are read.
      if (!bus.insecure)
      {
        opened = Open();
        if (!opened)
        {
          reader.Renew();
          return bus.Refuse(topic, writer, kNoSeal);
        }
        if (opened->writer != IdOf(writer)) return bus.Refuse(topic, writer, kOtherWriter);
        bus.Recognise(writer);
        bytes = opened->payload;
      }
      ReadPayload(bytes, message);
      if (opened)
      {
        const std::string* const instance = KeyOf(message);
        const std::string of = instance == nullptr ? std::string() : *instance;
        if (!opener.IsNew(*opened, of))
        {
          if (!reader.WasRenewed()) bus.Refuse(topic, writer, kRepetition);
          return;
        }
        opener.Note(*opened, of);
      }
      received(message);
    }
    catch (const ForeignMessage& error)
    {
      bus.Refuse(topic, writer, error.what());
    }
    catch (const BadMessage& error)
    {
      bus.Report(topic, writer, TickOf(message), error.what());
    }
  }

  std::optional<Opener::Opened> Open()
  {
    if (opener.Knows(payload)) return opener.Open(payload, room);
    if (grant) return grant->key ? opener.OpenBy(*grant->key, payload, room) : std::nullopt;
    std::optional<Opener::Opened> opened;
    bus.keys.Try(partition,
                 [&](const RunKey& key)
                 {
                   opened = opener.OpenBy(key, payload, room);
                   return opened.has_value();
                 });
    return opened;
  }

  Bus::Impl& bus;
  const std::string partition;
  const std::optional<GrantChannel> grant;
  const std::string topic;
  std::function<void(const Message&)> received;
  std::mutex mutex;
  std::vector<char> payload;
  std::vector<char> room;  // for what it holds
  Message message;
  Opener opener;
  RenewedReader reader;
};

template <class Message>
Subscription<Message>::Subscription(Bus& bus, const std::string& partition,
                                    std::function<void(const Message&)> received,
                                    const std::optional<GrantChannel>& grant)
    : impl_(std::make_unique<Impl>(bus, partition, std::move(received), grant))
{
}

template <class Message>
Subscription<Message>::~Subscription() = default;

template <class Message>
unsigned Subscription<Message>::Writers() const
{
  return impl_->reader.Matched();
}

#define SWARMANOID_INSTANTIATE(MESSAGE, TOPIC) \
  template class Publisher<MESSAGE>;           \
  template class Subscription<MESSAGE>;
SWARMANOID_COLD_MESSAGES(SWARMANOID_INSTANTIATE)
#undef SWARMANOID_INSTANTIATE

}  // namespace swarmanoid
