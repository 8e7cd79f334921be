// Writers and readers with the quality of service that the table asks for.
#include "common/bus/topics/participant.h"

namespace swarmanoid
{

namespace
{

constexpr int kExtraSamples = 4;  // a reader may hold these while the writer continues
constexpr int kMaximalProcesses = 4096;

DdsDuration Milliseconds(double ms) { return Seconds(ms / 1e3); }

}  // namespace

dds::DataWriterQos WriterQos(const TopicQos& topic, bool spreads)
{
  dds::DataWriterQos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = Milliseconds(100);
  qos.durability().kind = topic.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.writer_depth;
  qos.resource_limits().max_instances = topic.keyed ? kMaximalProcesses : 1;
  qos.resource_limits().max_samples_per_instance = topic.writer_depth;
  qos.resource_limits().max_samples = qos.resource_limits().max_instances * topic.writer_depth;
  qos.resource_limits().allocated_samples = topic.writer_depth;
  qos.resource_limits().extra_samples = kExtraSamples;
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  // Sets the heartbeat period while a reader has not confirmed a message. The period is the delay that a lost message
  // causes. On one machine messages are lost only if a process lags far behind, and then heartbeats would be more for
  // it to read: with 60 controller hosts most datagrams of the start were heartbeats and their answers.
  SetHeartbeatPeriod(qos, Milliseconds(topic.hot ? 1 : spreads ? 5 : 200));
  // Otherwise each datagram of a message has a heartbeat. The reader would answer with a list of datagrams still under
  // way.
  qos.reliable_writer_qos().disable_heartbeat_piggyback = topic.hot;
  SetNackResponseDelay(qos, Milliseconds(0));
  SetNackSuppression(qos, Milliseconds(0));
  return qos;
}

dds::DataReaderQos ReaderQos(const TopicQos& topic, unsigned writers)
{
  dds::DataReaderQos qos;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = topic.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.reader_depth * static_cast<int>(writers);
  qos.resource_limits().max_instances = topic.keyed ? kMaximalProcesses : 1;
  qos.resource_limits().max_samples_per_instance = qos.history().depth;
  qos.resource_limits().max_samples = qos.resource_limits().max_instances * qos.history().depth;
  qos.resource_limits().allocated_samples = qos.history().depth;
  qos.resource_limits().extra_samples = kExtraSamples;
  // Not DYNAMIC_RESERVE: a reader without room made before never confirms an empty message, which a stranger may send.
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  SetHeartbeatResponseDelay(qos, Milliseconds(topic.hot ? 0 : 0.2));
  return qos;
}

WriterEnd::WriterEnd(Bus& bus, dds::Topic* topic, const std::string& partition, const dds::DataWriterQos& qos)
    : participant_(bus.Internals().participant)
{
  dds::PublisherQos publisher_qos;
  publisher_qos.partition().push_back(partition.c_str());
  publisher_ = participant_->create_publisher(publisher_qos);
  writer_ = publisher_ == nullptr ? nullptr : publisher_->create_datawriter(topic, qos);
  if (writer_ == nullptr) throw BusError("cannot write topic " + topic->get_name());
}

// Empties the writer first. Fast DDS 2.9 returns a writer's messages one by one while its heartbeat may look for gaps
// between them. The heartbeat then never ends and holds the lock that all others need (its pull request 4076).
WriterEnd::~WriterEnd()
{
  std::size_t removed = 0;
  writer_->clear_history(&removed);
  publisher_->delete_datawriter(writer_);
  participant_->delete_publisher(publisher_);
}

unsigned WriterEnd::Matched() const
{
  dds::PublicationMatchedStatus status;
  writer_->get_publication_matched_status(status);
  return static_cast<unsigned>(status.current_count);
}

ReaderEnd::ReaderEnd(Bus& bus, dds::Topic* topic, const std::string& partition, const dds::DataReaderQos& qos,
                     dds::DataReaderListener* listener)
    : participant_(bus.Internals().participant)
{
  dds::SubscriberQos subscriber_qos;
  subscriber_qos.partition().push_back(partition.c_str());
  subscriber_ = participant_->create_subscriber(subscriber_qos);
  reader_ = subscriber_ == nullptr
                ? nullptr
                : subscriber_->create_datareader(topic, qos, listener, dds::StatusMask::data_available());
  if (reader_ == nullptr) throw BusError("cannot read topic " + topic->get_name());
}

ReaderEnd::~ReaderEnd()
{
  reader_->set_listener(nullptr);
  subscriber_->delete_datareader(reader_);
  participant_->delete_subscriber(subscriber_);
}

RenewedReader::RenewedReader(Bus& bus, std::function<std::unique_ptr<ReaderEnd>()> make)
    : later_(bus.Internals().later),
      name_("reader " + std::to_string(reinterpret_cast<std::uintptr_t>(this))),
      make_(std::move(make))
{
  // The listener may ask for a new reader before the first one exists.
  std::shared_ptr<ReaderEnd> first = make_();
  const std::lock_guard lock(mutex_);
  reader_ = std::move(first);
}

RenewedReader::~RenewedReader() { later_.Cancel(name_); }

void RenewedReader::Renew()
{
  later_.Schedule(name_, std::chrono::seconds(1),
                  [this]
                  {
                    renewed_ = true;
                    std::shared_ptr<ReaderEnd> old;
                    {
                      const std::lock_guard lock(mutex_);
                      old = std::move(reader_);
                    }
                    old.reset();
                    std::shared_ptr<ReaderEnd> fresh = make_();
                    const std::lock_guard lock(mutex_);
                    reader_ = std::move(fresh);
                  });
}

unsigned RenewedReader::Matched() const
{
  std::shared_ptr<ReaderEnd> reader;
  {
    const std::lock_guard lock(mutex_);
    reader = reader_;
  }
  return reader == nullptr ? 0 : reader->Matched();
}

unsigned ReaderEnd::Matched() const
{
  dds::SubscriptionMatchedStatus status;
  reader_->get_subscription_matched_status(status);
  return static_cast<unsigned>(status.current_count);
}

}  // namespace swarmanoid
