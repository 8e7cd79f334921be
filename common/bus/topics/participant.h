// The inside of the bus: the DDS participant with what its topics share. Only the sources of this folder include it.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <set>

#include "common/bus/bus.h"
#include "common/bus/dds/fast_dds.h"
#include "common/bus/delayed_calls.h"
#include "common/bus/security/key_ring.h"
#include "common/bus/security/seal.h"
#include "common/bus/security/signed_transport.h"
#include "common/bus/topics/qos.h"

namespace swarmanoid
{

void MarkBroken();

struct Bus::Impl : ParticipantListener
{
  Impl(const BusOptions& options, const std::string& name, const std::string& experiment);
  ~Impl() override;

  void OnParticipant(const DiscoveredParticipant& participant) override;

  // Reports a message that was dropped because it is invalid. It may end the run if its sender is a member.
  void Report(const std::string& topic, const rtps::GUID_t& writer, std::uint64_t tick, const std::string& what);
  // Reports a message that was dropped because its sender is unknown.
  void Refuse(const std::string& topic, const rtps::GUID_t& writer, const std::string& what);
  // Reports a datagram that was dropped because of its structure. It can name any process as its source, so only its
  // address identifies the sender.
  void RefuseDatagram(const std::string& what, const std::string& address);
  // Reports a datagram that was dropped because a sender without the key used the name of that process, or spoke about
  // it.
  void RefuseDatagram(const GuidPrefix& member, const std::string& sender);
  // A message with a good seal has come from that process.
  void Recognise(const rtps::GUID_t& writer);

  // Returns the topic of that name. The first call registers its type.
  dds::Topic* TopicOf(const std::string& name, const std::function<dds::TypeSupport()>& make_type);

  dds::DomainParticipant* participant = nullptr;
  DelayedCalls later;
  const bool insecure;
  const bool spreads;  // reaches other machines
  const std::optional<GrantChannel> grant;
  const std::shared_ptr<KeyRing> key_ring;
  KeyRing& keys = *key_ring;
  const std::shared_ptr<DatagramListener> datagrams = std::make_shared<DatagramListener>();
  std::mutex mutex;  // guards the members down to dropped_of
  std::map<std::string, dds::Topic*> topics;
  std::map<rtps::GuidPrefix_t, std::pair<std::string, std::string>> processes;  // "host:pid", name
  std::chrono::steady_clock::time_point last_join = std::chrono::steady_clock::now();
  std::function<void(const std::string&, const std::string&, bool)> on_gone;
  std::set<rtps::GuidPrefix_t> recognised;
  std::function<bool(const BadMessageReport&)> on_bad;
  std::function<void(const BadMessageReport&)> on_refused;
  std::string own_name;
  std::uint64_t dropped = 0;                                                // number of bad messages
  std::map<std::pair<std::string, std::string>, std::uint64_t> dropped_of;  // by sender and topic

private:
  void Gone(const std::pair<std::string, std::string>& process, bool died);
  BadMessageReport Describe(const std::string& topic, const rtps::GUID_t& writer, std::uint64_t tick,
                            const std::string& what);
  void Refuse(const BadMessageReport& report);
  // Returns true for the first one of that sender and topic.
  bool Drop(const BadMessageReport& report);

  // The silence after which a forged Leave is excluded: a process that said Leave has left, and a missed process is
  // dead. Any process can forge a Leave or a short lease.
  const std::chrono::duration<double> silence_of_leavers_;
  const std::chrono::duration<double> silence_of_dead_;
};

WriterId IdOf(const rtps::GUID_t& writer);

// One writer or reader with the publisher or subscriber that has its partition.
class WriterEnd
{
public:
  WriterEnd(Bus& bus, dds::Topic* topic, const std::string& partition, const dds::DataWriterQos& qos);
  ~WriterEnd();
  WriterEnd(const WriterEnd&) = delete;
  WriterEnd& operator=(const WriterEnd&) = delete;

  dds::DataWriter* operator->() const { return writer_; }
  // Returns false if there is no room for the message.
  bool Write(void* message) { return WriteMessage(*writer_, message); }
  unsigned Matched() const;

private:
  dds::DomainParticipant* participant_;
  dds::Publisher* publisher_;
  dds::DataWriter* writer_;
};

class ReaderEnd
{
public:
  ReaderEnd(Bus& bus, dds::Topic* topic, const std::string& partition, const dds::DataReaderQos& qos,
            dds::DataReaderListener* listener);
  ~ReaderEnd();
  ReaderEnd(const ReaderEnd&) = delete;
  ReaderEnd& operator=(const ReaderEnd&) = delete;

  unsigned Matched() const;

private:
  dds::DomainParticipant* participant_;
  dds::Subscriber* subscriber_;
  dds::DataReader* reader_;
};

// Replaces the reader of a subscription after another process has sent in the name of a writer. DDS counts the forged
// message as the writer's, and drops the real one with the same number. A new reader starts again, and receives what is
// kept for late readers.
class RenewedReader
{
public:
  // `make` returns a reader for the listener of the subscription.
  RenewedReader(Bus& bus, std::function<std::unique_ptr<ReaderEnd>()> make);
  ~RenewedReader();
  RenewedReader(const RenewedReader&) = delete;
  RenewedReader& operator=(const RenewedReader&) = delete;

  // Replaces the reader soon, but not before it is a second old. Its listener may call it, too.
  void Renew();
  // Returns whether the reader was replaced, so that messages may come again.
  bool WasRenewed() const { return renewed_; }
  unsigned Matched() const;

private:
  DelayedCalls& later_;
  const std::string name_;
  std::function<std::unique_ptr<ReaderEnd>()> make_;
  std::atomic<bool> renewed_ = false;
  // Guards reader_.
  mutable std::mutex mutex_;
  std::shared_ptr<ReaderEnd> reader_;  // held while a thread uses it
};

// `spreads`: messages may be lost on their way, since they reach other machines.
dds::DataWriterQos WriterQos(const TopicQos& topic, bool spreads);
dds::DataReaderQos ReaderQos(const TopicQos& topic, unsigned writers);

}  // namespace swarmanoid
