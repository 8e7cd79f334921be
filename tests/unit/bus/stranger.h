// A participant that is no process of Swarmanoid. It announces no name, and writes any bytes to any topic, on the
// loopback interface only.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "common/bus/topics/message_bytes.h"
#include "tests/eventually.h"
#include "tests/unit/bus/raw_type.h"

namespace swarmanoid::test
{

class Stranger
{
public:
  Stranger(int domain, const std::string& partition)
  {
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().user_transports.push_back(udp);
    participant_ =
        dds::DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(domain), qos);
    if (participant_ == nullptr) throw std::runtime_error("the stranger has no participant");
    dds::PublisherQos publisher;
    publisher.partition().push_back(partition.c_str());
    publisher_ = participant_->create_publisher(publisher);
  }
  ~Stranger()
  {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  // Writes the payloads once `readers` have matched, and waits until they have received them. Returns false if no
  // reader comes.
  bool Send(const std::string& topic_name, const std::vector<std::string>& payloads, int readers = 1)
  {
    dds::DataWriter* const writer = WriterOf(topic_name);
    if (writer == nullptr) return false;
    if (!Met(topic_name, readers)) return false;
    for (std::string payload : payloads) WriteMessage(*writer, &payload);
    const bool got = Succeeded(writer->wait_for_acknowledgments({static_cast<std::int32_t>(kGenerous.count()), 0}));
    std::size_t cleared = 0;
    writer->clear_history(&cleared);  // processes that join later do not get them
    return got;
  }

  // Returns whether `readers` have matched its writer on that topic.
  bool Met(const std::string& topic_name, int readers)
  {
    dds::DataWriter* const writer = WriterOf(topic_name);
    return writer != nullptr && Eventually(
                                    [&]
                                    {
                                      dds::PublicationMatchedStatus status;
                                      writer->get_publication_matched_status(status);
                                      return status.current_count >= readers;
                                    });
  }

  // Returns the GUID of that writer.
  WriterId Writer(const std::string& topic_name)
  {
    const auto& guid = WriterOf(topic_name)->guid();
    WriterId id{};
    std::copy(std::begin(guid.guidPrefix.value), std::end(guid.guidPrefix.value), id.begin());
    std::copy(std::begin(guid.entityId.value), std::end(guid.entityId.value), id.begin() + 12);
    return id;
  }

private:
  // Returns the writer of a topic. It lives as long as the stranger: messages that a reader has acknowledged but not
  // taken would be lost with their writer.
  dds::DataWriter* WriterOf(const std::string& topic_name)
  {
    if (dds::DataWriter* const known = publisher_->lookup_datawriter(topic_name)) return known;
    dds::TypeSupport type(new RawType(topic_name));
    type.register_type(participant_);
    dds::Topic* topic = participant_->create_topic(topic_name, type.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    dds::DataWriterQos qos;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.history().kind = dds::KEEP_ALL_HISTORY_QOS;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
    // A lost datagram is sent again at once, not after seconds.
    SetHeartbeatPeriod(qos, {0, 20'000'000});
    SetNackSuppression(qos, {0, 0});
    return publisher_->create_datawriter(topic, qos);
  }

  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
};

// Returns the payload of a message, well-formed.
template <class... Parts>
std::string PayloadOf(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '\0');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

}  // namespace swarmanoid::test
