// Listener: a participant that is no process of Swarmanoid. It reads all messages on a topic as bytes, on the loopback
// interface only.
#pragma once

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/bus/security/seal.h"
#include "tests/unit/bus/raw_type.h"

namespace swarmanoid::test
{

class Listener : dds::DataReaderListener
{
public:
  // `topic`: ends with the id of a grant behind a slash, if it belongs to one.
  Listener(int domain, const std::string& partition, const std::string& topic, const std::string& address = "127.0.0.1")
  {
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {address};
    qos.transport().user_transports.push_back(udp);
    participant_ =
        dds::DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(domain), qos);
    if (participant_ == nullptr) throw std::runtime_error("the listener has no participant");
    dds::TypeSupport type(new RawType(topic));
    type.register_type(participant_);
    dds::SubscriberQos subscriber;
    subscriber.partition().push_back(partition.c_str());
    dds::DataReaderQos reader;
    reader.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    reader.durability().kind = dds::VOLATILE_DURABILITY_QOS;
    reader.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    reader.data_sharing().off();
    participant_->create_subscriber(subscriber)
        ->create_datareader(participant_->create_topic(topic, type.get_type_name(), dds::TOPIC_QOS_DEFAULT), reader,
                            this);
  }
  ~Listener() override
  {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  struct Sample
  {
    WriterId writer;
    std::string payload;
  };
  std::vector<Sample> Samples()
  {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  // Returns all payloads, joined.
  std::string Heard()
  {
    std::string all;
    for (const Sample& sample : Samples()) all += sample.payload;
    return all;
  }

private:
  void on_data_available(dds::DataReader* reader) override
  {
    std::string payload;
    dds::SampleInfo about;
    while (Succeeded(reader->take_next_sample(&payload, &about)))
    {
      if (!about.valid_data) continue;
      const auto& guid = about.sample_identity.writer_guid();
      Sample sample{{}, payload};
      std::copy(std::begin(guid.guidPrefix.value), std::end(guid.guidPrefix.value), sample.writer.begin());
      std::copy(std::begin(guid.entityId.value), std::end(guid.entityId.value), sample.writer.begin() + 12);
      const std::lock_guard lock(mutex_);
      samples_.push_back(sample);
    }
  }

  dds::DomainParticipant* participant_ = nullptr;
  // Guards samples_.
  std::mutex mutex_;
  std::vector<Sample> samples_;
};

}  // namespace swarmanoid::test
