#include "common/bus/topics/message_type.h"
#include "common/bus/topics/participant.h"
#include "common/math/random.h"
#include "common/memory/shared_memory.h"
#include "common/run/access/run_directory.h"

#include <fmt/format.h>
#include <unistd.h>
#include <fstream>

namespace swarmanoid
{

namespace
{

constexpr std::size_t kOtherFiles = 128 * 1024;  // of the bus itself: who reads what

template <class Message>
dds::Topic* HotTopic(Bus& bus, const HotScope& scope)
{
  return bus.Internals().TopicOf(
      kTopicOf<Message>, [&] { return dds::TypeSupport(new HotType<Message>(scope.capacity + kMostSealBytes)); });
}

std::string PartitionOf(const HotScope& scope)
{
  return scope.listener.empty() ? scope.experiment : scope.experiment + "/" + scope.listener;
}

// Returns the key that seals messages to other machines; none if the run lets every process in. Throws BusError.
std::optional<RunKey> KeyOfTicks(Bus& bus, const HotScope& scope)
{
  if (!scope.spread || bus.Internals().insecure) return std::nullopt;
  const auto key = bus.Internals().keys.Of(scope.experiment);
  if (!key) throw BusError(fmt::format("this process has no key of the run of '{}'", scope.experiment));
  return key;
}

// The system kills a process that writes to shared memory beyond the free space.
void RequireSharedMemory(std::size_t bytes)
{
  if (SharedMemoryFree() >= bytes + kOtherFiles) return;
  throw BusError(fmt::format(
      "shared memory is full: {} has {} KiB left, and the messages of this run need {} KiB; free some of it, "
      "or let SWARMANOID_SHARED_FOLDER name a folder with more room",
      SharedMemoryFolder(), SharedMemoryFree() / 1024, (bytes + kOtherFiles) / 1024));
}

// Identifies processes that can share memory: the same user, kernel and network namespace.
std::uint16_t MachineId()
{
  std::string identity;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> identity;
  char link[128] = {};
  if (readlink("/proc/self/ns/net", link, sizeof(link) - 1) > 0) identity += link;
  identity += std::to_string(getuid());
  const auto hash = static_cast<std::uint32_t>(StreamName(identity));
  return static_cast<std::uint16_t>(hash ^ (hash >> 16));
}

bool SharesMemory(Bus& bus, const HotScope& scope)
{
  return !scope.directory.empty() && (!scope.spread || bus.Internals().insecure);
}

// Uses shared memory, which only processes of this user can open. A forged datagram of a writer that shares memory
// would end its reader. So memory and network are not used together, unless every process is let in. The endpoint's
// only address has a kind that the participant does not speak. Others discover the endpoint, but it receives nothing
// from the network.
template <class Qos>
void ShareData(Qos& qos, Bus& bus, const HotScope& scope)
{
  if (!SharesMemory(bus, scope)) return;
  RequireSameRelease(scope.directory, fmt::format("{}.{}", SWARMANOID_FAST_DDS_MAJOR, SWARMANOID_FAST_DDS_MINOR));
  qos.data_sharing().on(scope.directory, {MachineId()});
  if (bus.Internals().insecure) return;
  qos.endpoint().unicast_locator_list.push_back(NowhereLocator());
}

}  // namespace

template <class Message>
struct HotPublisher<Message>::Impl
{
  Impl(Bus& bus, const HotScope& scope)
      : capacity(scope.capacity), writer(bus, HotTopic<Message>(bus, scope), PartitionOf(scope), Qos(bus, scope))
  {
    if (const auto key = KeyOfTicks(bus, scope)) sealer.emplace(*key, kTopicOf<Message>);
  }

  static dds::DataWriterQos Qos(Bus& bus, const HotScope& scope)
  {
    dds::DataWriterQos qos = WriterQos(QosOf(kTopicOf<Message>), scope.spread);
    const auto samples = qos.resource_limits().max_samples + qos.resource_limits().extra_samples;
    if (SharesMemory(bus, scope))
      RequireSharedMemory((scope.capacity + kMostSealBytes) * static_cast<std::size_t>(samples));
    ShareData(qos, bus, scope);
    return qos;
  }

  std::size_t capacity;
  WriterEnd writer;
  std::optional<Sealer> sealer;
};

template <class Message>
HotPublisher<Message>::HotPublisher(Bus& bus, const HotScope& scope) : impl_(std::make_unique<Impl>(bus, scope))
{
}

template <class Message>
HotPublisher<Message>::~HotPublisher() = default;

template <class Message>
void HotPublisher<Message>::Write(const MessageHeader& header, const Message& message)
{
  HotWrite<Message> call{&header, &message, PayloadSize(header, message), impl_->sealer ? &*impl_->sealer : nullptr,
                         IdOf(impl_->writer->guid())};
  if (call.size > impl_->capacity)
    throw BusError(fmt::format("cannot send {} of tick {}: it has {} bytes, and {} at most by the experiment",
                               kTopicOf<Message>, header.tick, call.size, impl_->capacity));
  bool written = false;
  try
  {
    written = impl_->writer.Write(&call);
  }
  catch (const std::exception&)
  {
    // A reader died while it held its lock. Its lease will tell which process it was.
    MarkBroken();
    return;
  }
  if (!written)
    throw BusError(fmt::format("cannot send {} of tick {}: the bus is full", kTopicOf<Message>, header.tick));
}

template <class Message>
unsigned HotPublisher<Message>::Readers() const
{
  return impl_->writer.Matched();
}

template <class Message>
struct HotSubscription<Message>::Impl : dds::DataReaderListener
{
  Impl(Bus& its_bus, const HotScope& scope, Handler its_handler)
      : bus(its_bus),
        handler(std::move(its_handler)),
        opener{KeyOfTicks(bus, scope), Opener(kTopicOf<Message>), {}},
        reader(bus,
               [this, &its_bus, scope]
               {
                 return std::make_unique<ReaderEnd>(its_bus, HotTopic<Message>(its_bus, scope), PartitionOf(scope),
                                                    Qos(its_bus, scope), this);
               })
  {
  }

  static dds::DataReaderQos Qos(Bus& bus, const HotScope& scope)
  {
    dds::DataReaderQos qos = ReaderQos(QosOf(kTopicOf<Message>), scope.writers);
    if (!scope.spread) qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    ShareData(qos, bus, scope);
    return qos;
  }

  void on_data_available(dds::DataReader* source) override
  {
    const std::lock_guard lock(mutex);
    HotRead<Message> call{&handler, {}, nullptr, {}, &opener};
    dds::SampleInfo about;
    while (Succeeded(source->take_next_sample(&call, &about)))
    {
      if (!about.valid_data) continue;
      const auto& writer = about.sample_identity.writer_guid();
      if (call.opened && call.refused == nullptr)
      {
        if (call.opened->writer != IdOf(writer))
          call.refused = kOtherWriter;
        else
        {
          opener.opener.Note(*call.opened);
          known.insert(call.opened->writer);
        }
      }
      if (call.refused == kNoSeal && known.count(IdOf(writer)) > 0) reader.Renew();
      if (call.refused != nullptr)
        bus.Internals().Refuse(kTopicOf<Message>, writer, call.refused);
      else if (!call.error.empty())
        bus.Internals().Report(kTopicOf<Message>, writer, call.header.tick, call.error);
      else if (call.message != nullptr)
        handler.received(call.header, *call.message);
    }
  }

  Bus& bus;
  Handler handler;
  HotOpener opener;
  std::mutex mutex;          // data sharing and network readers call from threads of their own
  std::set<WriterId> known;  // the writers that have sealed a message
  RenewedReader reader;
};

template <class Message>
HotSubscription<Message>::HotSubscription(Bus& bus, const HotScope& scope, Handler handler)
    : impl_(std::make_unique<Impl>(bus, scope, std::move(handler)))
{
}

template <class Message>
HotSubscription<Message>::~HotSubscription() = default;

template <class Message>
unsigned HotSubscription<Message>::Writers() const
{
  return impl_->reader.Matched();
}

#define SWARMANOID_INSTANTIATE(MESSAGE, TOPIC) \
  template class HotPublisher<MESSAGE>;        \
  template class HotSubscription<MESSAGE>;
SWARMANOID_HOT_MESSAGES(SWARMANOID_INSTANTIATE)
#undef SWARMANOID_INSTANTIATE

}  // namespace swarmanoid
