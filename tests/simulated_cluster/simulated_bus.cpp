// Implements common/bus/bus.h, the folder of a run and the identity of processes for simulated processes. The simulated
// cluster links this instead of the bus. All code above it is the product's.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/bus/bus.h"
#include "common/bus/topics/message_fields.h"
#include "common/run/access/run_directory.h"
#include "tests/simulated_cluster/simulated_network.h"

namespace swarmanoid
{

using test::IdOf;
using test::Sample;
using test::SimulatedBus;
using test::SimulatedCopy;
using test::SimulatedNetwork;
using test::SimulatedReader;
using test::SimulatedWriter;
using test::Simulation;

bool BusIsBroken() { return false; }

void EndAtOnce(int code) { Simulation::Current().EndProcess(code); }

std::string ProcessId() { return IdOf(Simulation::Current().CurrentProcess()); }

std::string MachineName() { return Simulation::Current().CurrentProcess().machine; }

bool IsAlive(long pid)
{
  for (const auto& process : Simulation::Current().Processes())
    if (process->pid == pid) return process->is_alive;
  return false;
}

std::string UserName() { return "user"; }

std::optional<RunKey> GivenKey(const BusOptions& options) { return options.key; }

struct Bus::Impl
{
  std::shared_ptr<SimulatedBus> bus;
};

Bus::Bus(const BusOptions&, const std::string& name, const std::string&)
    : impl_(std::make_unique<Impl>(Impl{SimulatedNetwork::Current().Join(name)}))
{
}

Bus::~Bus() { SimulatedNetwork::Current().Leave(impl_->bus); }

void Bus::OnProcessGone(std::function<void(const std::string&, const std::string&, bool)> callback)
{
  impl_->bus->on_gone = std::move(callback);
}

void Bus::OnBadMessage(std::function<bool(const BadMessageReport&)> callback)
{
  impl_->bus->on_bad = std::move(callback);
}

bool Bus::MaySpeakTo(const std::string&) { return true; }

void Bus::OnRefused(std::function<void(const BadMessageReport&)> callback)
{
  impl_->bus->on_refused = std::move(callback);
}

std::uint64_t Bus::Dropped() const { return impl_->bus->dropped; }

// There are no threads of Fast DDS that endpoints must wait for.
std::chrono::duration<double> Bus::SinceLastJoin() const { return std::chrono::duration<double>::max(); }

namespace
{

// Calls a function that reads a message, and reports a bad one.
template <class Message, class Call>
void TellBad(SimulatedBus& bus, const Sample& sample, const Call& call)
{
  try
  {
    call();
  }
  catch (const ForeignMessage&)
  {
    ++bus.dropped;
  }
  catch (const BadMessage& error)
  {
    const BadMessageReport report{kTopicOf<Message>,  sample.process, sample.name,
                                  sample.header.tick, error.what(),   sample.name};
    if (!bus.on_bad || !bus.on_bad(report)) ++bus.dropped;
  }
}

std::string PartitionOf(const HotScope& scope)
{
  return scope.listener.empty() ? scope.experiment : scope.experiment + "/" + scope.listener;
}

template <class Message>
std::string TopicOf(const std::optional<GrantChannel>& grant)
{
  return grant ? fmt::format("{}/{}", kTopicOf<Message>, grant->id) : std::string(kTopicOf<Message>);
}

// Gives a place the content that it has while a message is copied there: a step that reads it has a wrong result.
template <class Message>
void Spoil(Message& place)
{
  if constexpr (requires { place.values; })
    std::ranges::fill(place.values, std::numeric_limits<double>::quiet_NaN());
  else
    place = Message();
}

std::shared_ptr<SimulatedReader> NewReader(const std::string& topic, const std::string& partition, std::size_t depth)
{
  auto reader = std::make_shared<SimulatedReader>();
  reader->process = &Simulation::Current().CurrentProcess();
  reader->topic = topic;
  reader->partition = partition;
  reader->depth = depth;
  return reader;
}

}  // namespace

template <class Message>
struct HotPublisher<Message>::Impl
{
  std::shared_ptr<SimulatedWriter> writer;
};

template <class Message>
HotPublisher<Message>::HotPublisher(Bus& bus, const HotScope& scope)
    : impl_(std::make_unique<Impl>(Impl{SimulatedNetwork::Current().AddWriter(*bus.Internals().bus, kTopicOf<Message>,
                                                                              kTopicOf<Message>, PartitionOf(scope))}))
{
}

template <class Message>
HotPublisher<Message>::~HotPublisher()
{
  SimulatedNetwork::Current().Close(*impl_->writer);
}

template <class Message>
void HotPublisher<Message>::Write(const MessageHeader& header, const Message& message)
{
  SimulatedNetwork::Current().Send(*impl_->writer, {std::make_shared<const Message>(message), header, {}, {}});
}

template <class Message>
unsigned HotPublisher<Message>::Readers() const
{
  return SimulatedNetwork::Current().Readers(*impl_->writer);
}

template <class Message>
struct HotSubscription<Message>::Impl
{
  std::shared_ptr<SimulatedReader> reader;
};

template <class Message>
HotSubscription<Message>::HotSubscription(Bus& bus, const HotScope& scope, Handler handler)
    : impl_(std::make_unique<Impl>(Impl{
          NewReader(kTopicOf<Message>, PartitionOf(scope),
                    static_cast<std::size_t>(QosOf(kTopicOf<Message>).reader_depth) * std::max(scope.writers, 1U))}))
{
  impl_->reader->take = [its_bus = bus.Internals().bus,
                         handler = std::make_shared<const Handler>(std::move(handler))](const Sample& sample)
  {
    SimulatedCopy copy;
    TellBad<Message>(*its_bus, sample,
                     [&]
                     {
                       Message* const place = handler->choose(sample.header);
                       if (place == nullptr) return;
                       copy.spoil = [place] { Spoil(*place); };
                       copy.end = [its_bus, handler, sample, place]
                       {
                         TellBad<Message>(*its_bus, sample,
                                          [&]
                                          {
                                            *place = *static_cast<const Message*>(sample.message.get());
                                            if (handler->check) handler->check(sample.header, *place);
                                            handler->received(sample.header, *place);
                                          });
                       };
                     });
    return copy;
  };
  SimulatedNetwork::Current().Add(impl_->reader);
}

template <class Message>
HotSubscription<Message>::~HotSubscription()
{
  SimulatedNetwork::Current().Close(*impl_->reader);
}

template <class Message>
unsigned HotSubscription<Message>::Writers() const
{
  return SimulatedNetwork::Current().Writers(*impl_->reader);
}

template <class Message>
struct Publisher<Message>::Impl
{
  std::shared_ptr<SimulatedWriter> writer;
};

template <class Message>
Publisher<Message>::Publisher(Bus& bus, const std::string& partition, const std::optional<GrantChannel>& grant)
    : impl_(std::make_unique<Impl>(Impl{SimulatedNetwork::Current().AddWriter(
          *bus.Internals().bus, TopicOf<Message>(grant), kTopicOf<Message>, partition)}))
{
}

template <class Message>
Publisher<Message>::~Publisher()
{
  SimulatedNetwork::Current().Close(*impl_->writer);
}

template <class Message>
void Publisher<Message>::Write(const Message& message)
{
  SimulatedNetwork::Current().Send(*impl_->writer, {std::make_shared<const Message>(message), {}, {}, {}});
}

template <class Message>
void Publisher<Message>::Forget()
{
  impl_->writer->kept.clear();
}

template <class Message>
unsigned Publisher<Message>::Readers() const
{
  return SimulatedNetwork::Current().Readers(*impl_->writer);
}

template <class Message>
bool Publisher<Message>::WaitUntilRead(double seconds)
{
  Simulation& simulation = Simulation::Current();
  const RunTime until =
      simulation.Now() + std::chrono::duration_cast<test::Duration>(std::chrono::duration<double>(seconds));
  while (*impl_->writer->underway > 0)
  {
    if (simulation.Now() >= until) return false;
    simulation.Sleep(std::chrono::milliseconds(2));
  }
  return true;
}

template <class Message>
struct Subscription<Message>::Impl
{
  std::shared_ptr<SimulatedReader> reader;
};

template <class Message>
Subscription<Message>::Subscription(Bus& bus, const std::string& partition,
                                    std::function<void(const Message&)> received,
                                    const std::optional<GrantChannel>& grant)
    : impl_(std::make_unique<Impl>(Impl{NewReader(TopicOf<Message>(grant), partition, 0)}))
{
  impl_->reader->take = [its_bus = bus.Internals().bus, received = std::move(received)](const Sample& sample)
  {
    TellBad<Message>(*its_bus, sample, [&] { received(*static_cast<const Message*>(sample.message.get())); });
    return SimulatedCopy();
  };
  SimulatedNetwork::Current().Add(impl_->reader);
}

template <class Message>
Subscription<Message>::~Subscription()
{
  SimulatedNetwork::Current().Close(*impl_->reader);
}

template <class Message>
unsigned Subscription<Message>::Writers() const
{
  return SimulatedNetwork::Current().Writers(*impl_->reader);
}

#define SWARMANOID_INSTANTIATE(MESSAGE, TOPIC) \
  template class HotPublisher<MESSAGE>;        \
  template class HotSubscription<MESSAGE>;
SWARMANOID_HOT_MESSAGES(SWARMANOID_INSTANTIATE)
#undef SWARMANOID_INSTANTIATE

#define SWARMANOID_INSTANTIATE(MESSAGE, TOPIC) \
  template class Publisher<MESSAGE>;           \
  template class Subscription<MESSAGE>;
SWARMANOID_COLD_MESSAGES(SWARMANOID_INSTANTIATE)
#undef SWARMANOID_INSTANTIATE

RunDirectory::RunDirectory(const std::string&, std::uint64_t) {}
void RunDirectory::Leave() {}
void RunDirectory::Announce(const std::string&, int, const std::optional<RunKey>&, const RunNetwork&) {}
void RunDirectory::AnnounceFolder(const std::string&) {}
std::vector<LocalRun> FindLocalRuns() { return {}; }

}  // namespace swarmanoid
