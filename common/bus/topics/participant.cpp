// Every process in the network may send, so nothing that comes is trusted. Datagrams go through the transports of
// common/bus/security first. In a run with a key, a process counts once a message of it has been opened by the key
// (Recognise). The ends of others are ignored. A forged announcement could end a process or shorten its lease. So an
// end takes effect only after a time of silence, in which a living process is heard again.
//
// Invariants: callbacks run without the mutex; after the destructor of Impl no listener is called, although a
// participant of Fast DDS may live on; the first bad message of a sender on a topic is reported, and further ones are
// only counted.
#include "common/bus/topics/participant.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "common/activity/failure_report.h"
#include "common/configuration/shown_text.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/logging/log.h"
#include "common/run/access/addresses.h"
#include "common/run/access/dds_environment.h"

namespace swarmanoid
{

namespace
{

constexpr unsigned kSocketBuffer = 4U << 20;  // bytes; 10,000 robots lose datagrams with the system's default
constexpr double kLongestPeriod_s = 0.5;      // the longest time between two announcements of a process
constexpr std::size_t kSendersTold = 100;     // limit for the senders of bad messages in the log, by topic
constexpr std::size_t kLongestSender = 200;   // bytes of a name in the log

// Routes the log of Fast DDS. By default it writes to standard output, which is for the results of a run.
class DdsLog : public dds::LogConsumer
{
public:
  void Consume(const dds::Log::Entry& entry) override
  {
    LogInfo("Fast DDS, {}: {}", entry.context.category, entry.message);
  }
};

bool KeepLog()
{
  dds::Log::ClearConsumers();
  dds::Log::RegisterConsumer(std::make_unique<DdsLog>());
  return true;
}
// The multicast group of DDS discovery and its ports (RTPS 2.2, 9.6.1).
constexpr const char* kMulticastGroup = "239.255.0.1";
constexpr unsigned kFirstPort = 7400, kPortsOfADomain = 250;
constexpr std::uint32_t kMostProcesses = 2048;  // of one domain on a machine
constexpr unsigned kPeerProcesses = 100;  // number of participants that are searched on each machine named as a peer

std::atomic<bool> broken = false;

// A bus thread that waits for a lock of a dead process gets an exception that no code catches. That thread is put to
// sleep. The dead process's lease tells the main thread which process died. The main thread itself would sleep for
// ever.
void SleepInsteadOfTerminate()
{
  if (!std::current_exception()) DieOf("called std::terminate");
  const std::string text = CurrentExceptionText();
  if (text.find("Interprocess") != std::string::npos)
  {
    MarkBroken();
    if (gettid() == getpid()) EndAtOnce(kExitStuck);
    while (true) pause();
  }
  DieOf("ended by an uncaught exception: " + text);
}

rtps::Locator_t LocatorOf(const std::string& host, unsigned port)
{
  rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = port;
  rtps::IPLocator::setIPv4(locator, ResolveHost(host));
  return locator;
}

// Discovery through the space server: its participant has a prefix that follows from the domain.
void UseDiscoveryServer(const BusOptions& options, rtps::BuiltinAttributes& builtin, rtps::GuidPrefix_t& own_prefix)
{
  const auto address = ParseServerAddress(options.discovery_server);
  if (!address)
    throw BusError(
        fmt::format("'{}' is not the address of a discovery server; write ADDRESS:PORT", options.discovery_server));
  const rtps::Locator_t locator = LocatorOf(address->first, address->second);
  const std::string prefix = fmt::format("53.57.41.52.4d.41.4e.4f.49.44.{:02x}.01", options.domain);

  builtin.discovery_config.discoveryServer_client_syncperiod = Seconds(0.05);
  if (options.serves_discovery)
  {
    builtin.discovery_config.discoveryProtocol = kDiscoveryServer;
    std::istringstream(prefix) >> own_prefix;
    builtin.metatrafficUnicastLocatorList.push_back(locator);
    return;
  }
  builtin.discovery_config.discoveryProtocol = kDiscoveryClient;
  AddDiscoveryServer(builtin, prefix, locator);
}

}  // namespace

void MarkBroken() { broken = true; }

bool BusIsBroken() { return broken; }

void EndAtOnce(int code) { LeaveAtOnce(code); }

std::string MachineName()
{
  char name[256] = {};
  gethostname(name, sizeof(name) - 1);
  return name;
}

bool IsAlive(long pid) { return kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM; }

std::string ProcessId() { return fmt::format("{}:{}", MachineName(), getpid()); }

WriterId IdOf(const rtps::GUID_t& writer)
{
  WriterId id{};
  std::copy(std::begin(writer.guidPrefix.value), std::end(writer.guidPrefix.value), id.begin());
  std::copy(std::begin(writer.entityId.value), std::end(writer.entityId.value), id.begin() + 12);
  return id;
}

Bus::Impl::Impl(const BusOptions& options, const std::string& name, const std::string& experiment)
    : insecure(options.insecure),
      spreads(options.Spread()),
      grant(options.grant),
      key_ring(std::make_shared<KeyRing>(options.domain, GivenKey(options))),
      own_name(name),
      // A living process is heard again before this time, unless four announcements are lost.
      silence_of_leavers_(std::min(options.lease_s, 4 * kLongestPeriod_s)),
      silence_of_dead_(std::min(options.lease_s / 2, 4 * kLongestPeriod_s))
{
  if (options.domain < 0 || options.domain > 232)
    throw BusError(fmt::format("domain {}: it must be 0 to 232", options.domain));
  std::set_terminate(SleepInsteadOfTerminate);
  // Members drop unsigned datagrams of a process that has signed one. Discovery would lose those on their way, and
  // repeat them a second later.
  if (!insecure && !grant && !experiment.empty()) key_ring->Of(experiment);

  dds::DomainParticipantQos qos;
  qos.name(name.c_str());
  const std::string process = ProcessId();
  qos.user_data().setValue({process.begin(), process.end()});

  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBuffer;
  udp->receiveBufferSize = kSocketBuffer;
  udp->maxMessageSize = options.DatagramBytes();
  udp->maxInitialPeersRange = kPeerProcesses;
  udp->interfaceWhiteList = InterfaceAddresses(options.network_interface);
  datagrams->malformed = [this](const std::string& what, const std::string& address) { RefuseDatagram(what, address); };
  datagrams->forged = [this](const GuidPrefix& member, const std::string& sender) { RefuseDatagram(member, sender); };
  if (insecure)
    qos.transport().user_transports.push_back(std::make_shared<DiscardingTransportDescriptor>(udp, spreads, datagrams));
  else
    qos.transport().user_transports.push_back(std::make_shared<SignedTransportDescriptor>(
        udp, spreads, std::make_shared<DatagramSignatures>(key_ring), datagrams));

  rtps::BuiltinAttributes& builtin = qos.wire_protocol().builtin;
  // Each process on a machine takes the next free port. Fast DDS goes on without one that it does not find, deaf.
  builtin.mutation_tries = kMostProcesses;
  builtin.discovery_config.initial_announcements.count = 20;
  builtin.discovery_config.initial_announcements.period = Seconds(0.05);
  builtin.discovery_config.leaseDuration = Seconds(options.lease_s);
  builtin.discovery_config.leaseDuration_announcementperiod = Seconds(std::min(options.lease_s / 4, kLongestPeriod_s));
  if (!options.discovery_server.empty())
    UseDiscoveryServer(options, builtin, qos.wire_protocol().prefix);
  else if (!options.peers.empty())
  {
    // Those on this machine are peers too.
    for (const std::string& own : udp->interfaceWhiteList) builtin.initialPeersList.push_back(LocatorOf(own, 0));
    if (udp->interfaceWhiteList.empty()) builtin.initialPeersList.push_back(LocatorOf("127.0.0.1", 0));
    for (const std::string& peer : options.peers) builtin.initialPeersList.push_back(LocatorOf(peer, 0));
  }
  else if (!options.hears_announcements && !options.Spread())
  {
    // An address of its own for discovery takes the place of the multicast group, to which it still announces itself.
    builtin.metatrafficUnicastLocatorList.push_back(LocatorOf("127.0.0.1", 0));
    builtin.initialPeersList.push_back(
        LocatorOf(kMulticastGroup, kFirstPort + kPortsOfADomain * static_cast<unsigned>(options.domain)));
  }

  [[maybe_unused]] static const bool logs = KeepLog();
  const HiddenDdsVariables hidden;
  participant = dds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(options.domain), qos, this, dds::StatusMask::none());
  if (participant == nullptr)
    throw BusError(
        fmt::format("cannot join domain {} on interface {}: too many processes in the domain, or no socket free",
                    options.domain, options.network_interface));
}

Bus::Impl::~Impl()
{
  participant->set_listener(nullptr);
  later.Stop();
  {
    const std::lock_guard lock(datagrams->mutex);
    datagrams->malformed = nullptr;
    datagrams->forged = nullptr;
  }
  for (const auto& [of, count] : dropped_of)
    if (count > 1) PrintError("{}: dropped {} bad {} messages of {} in all\n", own_name, count, of.second, of.first);
  for (const auto& [name, topic] : topics) participant->delete_topic(topic);
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}

void Bus::Impl::OnParticipant(const DiscoveredParticipant& found)
{
  const rtps::GuidPrefix_t prefix = found.prefix;
  std::ostringstream who;
  who << prefix;
  if (found.change == DiscoveredParticipant::Change::kPresent)
  {
    later.Forget(who.str());
    const std::lock_guard lock(mutex);
    if (!processes.contains(prefix)) last_join = std::chrono::steady_clock::now();
    processes[prefix] = {found.user_data, found.name};
    return;
  }
  const bool died = found.change == DiscoveredParticipant::Change::kDropped;
  std::pair<std::string, std::string> gone;
  {
    const std::lock_guard lock(mutex);
    const auto known = processes.find(prefix);
    if (known == processes.end()) return;
    gone = known->second;
    // Any process can claim to be a process of the run, and leave.
    if (!insecure && recognised.count(prefix) == 0)
    {
      processes.erase(known);
      return;
    }
    if (insecure) processes.erase(known);
  }
  if (insecure) return Gone(gone, died);
  // A forged announcement can also shorten the lease of the process.
  later.Schedule(who.str(), died ? silence_of_dead_ : silence_of_leavers_,
                 [this, prefix, gone, died]
                 {
                   {
                     const std::lock_guard lock(mutex);
                     processes.erase(prefix);
                     recognised.erase(prefix);
                   }
                   Gone(gone, died);
                 });
}

void Bus::Impl::Gone(const std::pair<std::string, std::string>& process, bool died)
{
  std::function<void(const std::string&, const std::string&, bool)> callback;
  {
    const std::lock_guard lock(mutex);
    callback = on_gone;
  }
  if (callback) callback(process.first, process.second, died);
}

void Bus::Impl::Report(const std::string& topic, const rtps::GUID_t& writer, std::uint64_t tick,
                       const std::string& what)
{
  const BadMessageReport report = Describe(topic, writer, tick, what);
  std::function<bool(const BadMessageReport&)> callback;
  {
    const std::lock_guard lock(mutex);
    callback = on_bad;
  }
  if (!callback || !callback(report)) Drop(report);
}

void Bus::Impl::Refuse(const std::string& topic, const rtps::GUID_t& writer, const std::string& what)
{
  Refuse(Describe(topic, writer, 0, what));
}

void Bus::Impl::Refuse(const BadMessageReport& report)
{
  if (!Drop(report)) return;
  std::function<void(const BadMessageReport&)> callback;
  {
    const std::lock_guard lock(mutex);
    callback = on_refused;
  }
  if (callback) callback(report);
}

void Bus::Impl::RefuseDatagram(const std::string& what, const std::string& address)
{
  Refuse({.topic = "RTPS", .process = {}, .name = {}, .what = what, .sender = address});
}

void Bus::Impl::RefuseDatagram(const GuidPrefix& member, const std::string& sender)
{
  rtps::GUID_t guid;
  std::copy(member.begin(), member.end(), std::begin(guid.guidPrefix.value));
  Refuse("RTPS", guid, "somebody without the key of this run spoke in its name, or about it; it came from " + sender);
}

void Bus::Impl::Recognise(const rtps::GUID_t& writer)
{
  const std::lock_guard lock(mutex);
  recognised.insert(writer.guidPrefix);
}

BadMessageReport Bus::Impl::Describe(const std::string& topic, const rtps::GUID_t& writer, std::uint64_t tick,
                                     const std::string& what)
{
  BadMessageReport report{topic, {}, {}, tick, what};
  const std::lock_guard lock(mutex);
  const auto sender = processes.find(writer.guidPrefix);
  if (sender != processes.end()) std::tie(report.process, report.name) = sender->second;
  std::ostringstream guid;
  guid << writer.guidPrefix;
  report.sender = report.process.empty() ? "an unknown process (" + guid.str() + ")"
                                         : fmt::format("'{}' (process {})", ShowableLine(report.name, kLongestSender),
                                                       ShowableLine(report.process, kLongestSender));
  return report;
}

bool Bus::Impl::Drop(const BadMessageReport& report)
{
  const std::lock_guard lock(mutex);
  ++dropped;
  if (dropped_of.size() >= kSendersTold && dropped_of.count({report.sender, report.topic}) == 0) return false;
  if (++dropped_of[{report.sender, report.topic}] != 1) return false;
  PrintError("{}: dropped a bad {} message of {}: {}; further ones are counted only\n", own_name, report.topic,
             report.sender, report.what);
  return true;
}

dds::Topic* Bus::Impl::TopicOf(const std::string& name, const std::function<dds::TypeSupport()>& make_type)
{
  const std::lock_guard lock(mutex);
  if (const auto found = topics.find(name); found != topics.end()) return found->second;
  dds::TypeSupport type = make_type();
  dds::Topic* topic = nullptr;
  if (Succeeded(type.register_type(participant)))
    topic = participant->create_topic(name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) throw BusError("cannot create topic " + name);
  topics[name] = topic;
  return topic;
}

Bus::Bus(const BusOptions& options, const std::string& name, const std::string& experiment)
    : impl_(std::make_unique<Impl>(options, name, experiment))
{
}
Bus::~Bus() = default;

void Bus::OnProcessGone(std::function<void(const std::string&, const std::string&, bool)> callback)
{
  const std::lock_guard lock(impl_->mutex);
  impl_->on_gone = std::move(callback);
}

void Bus::OnBadMessage(std::function<bool(const BadMessageReport&)> callback)
{
  const std::lock_guard lock(impl_->mutex);
  impl_->on_bad = std::move(callback);
}

void Bus::OnRefused(std::function<void(const BadMessageReport&)> callback)
{
  const std::lock_guard lock(impl_->mutex);
  impl_->on_refused = std::move(callback);
}

bool Bus::MaySpeakTo(const std::string& experiment)
{
  return impl_->insecure || impl_->keys.Of(experiment).has_value();
}

std::uint64_t Bus::Dropped() const
{
  const std::lock_guard lock(impl_->mutex);
  return impl_->dropped;
}

std::chrono::duration<double> Bus::SinceLastJoin() const
{
  const std::lock_guard lock(impl_->mutex);
  return std::chrono::steady_clock::now() - impl_->last_join;
}

}  // namespace swarmanoid
