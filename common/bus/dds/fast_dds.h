// The parts of Fast DDS that this project uses, under one set of names for releases 2.9 to 3.1.
//
// This folder is the only place that knows which release is installed. All other files include its headers instead of
// those of Fast DDS, and use the namespaces `dds` and `rtps` and the names below. It has no library of its own: the
// CMake target `fast_dds` brings the headers and the libraries of the release.
#pragma once

#include "common/bus/dds/release.h"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#if SWARMANOID_FAST_DDS_MAJOR >= 3
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#endif

#include <chrono>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace swarmanoid
{

namespace dds = eprosima::fastdds::dds;
namespace transport = eprosima::fastdds::rtps;

#if SWARMANOID_FAST_DDS_MAJOR >= 3
namespace rtps = eprosima::fastdds::rtps;
using DdsDuration = dds::Duration_t;
inline constexpr auto kDiscoveryClient = rtps::DiscoveryProtocol::CLIENT;
inline constexpr auto kDiscoveryServer = rtps::DiscoveryProtocol::SERVER;
#else
namespace rtps = eprosima::fastrtps::rtps;
using DdsDuration = eprosima::fastrtps::Duration_t;
inline constexpr auto kDiscoveryClient = rtps::DiscoveryProtocol_t::CLIENT;
inline constexpr auto kDiscoveryServer = rtps::DiscoveryProtocol_t::SERVER;
#endif

// Seconds as Fast DDS counts them. `seconds` must not be negative.
inline DdsDuration Seconds(double seconds)
{
  const double whole = std::floor(seconds);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>((seconds - whole) * 1e9)};
}

// Returns true if a call of Fast DDS succeeded.
#if SWARMANOID_FAST_DDS_MAJOR >= 3
inline bool Succeeded(dds::ReturnCode_t code) { return code == dds::RETCODE_OK; }
#else
inline bool Succeeded(const eprosima::fastrtps::types::ReturnCode_t& code)
{
  return code == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
}
#endif

// Hands a message to a writer. Returns false if the writer has no room for it.
inline bool WriteMessage(dds::DataWriter& writer, void* message)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return Succeeded(writer.write(message));
#else
  return writer.write(message);
#endif
}

// The times of the reliable protocol. Writer: from the last message to its next heartbeat, and the delays before it
// answers a request for a lost message, and the next one. Reader: the delay before it answers a heartbeat.
inline void SetHeartbeatPeriod(dds::DataWriterQos& qos, DdsDuration period)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  qos.reliable_writer_qos().times.heartbeat_period = period;
#else
  qos.reliable_writer_qos().times.heartbeatPeriod = period;
#endif
}

inline void SetNackResponseDelay(dds::DataWriterQos& qos, DdsDuration delay)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  qos.reliable_writer_qos().times.nack_response_delay = delay;
#else
  qos.reliable_writer_qos().times.nackResponseDelay = delay;
#endif
}

inline void SetNackSuppression(dds::DataWriterQos& qos, DdsDuration duration)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  qos.reliable_writer_qos().times.nack_supression_duration = duration;
#else
  qos.reliable_writer_qos().times.nackSupressionDuration = duration;
#endif
}

inline void SetHeartbeatResponseDelay(dds::DataReaderQos& qos, DdsDuration delay)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  qos.reliable_reader_qos().times.heartbeat_response_delay = delay;
#else
  qos.reliable_reader_qos().times.heartbeatResponseDelay = delay;
#endif
}

// Adds a discovery server to the servers that a client asks. Releases before 3 know a server by its prefix, too
// ("53.57.….01"); from 3 on its address is enough.
inline void AddDiscoveryServer(rtps::BuiltinAttributes& builtin, [[maybe_unused]] const std::string& prefix,
                               const rtps::Locator_t& address)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  builtin.discovery_config.m_DiscoveryServers.push_back(address);
#else
  eprosima::fastdds::rtps::RemoteServerAttributes server;
  server.ReadguidPrefix(prefix.c_str());
  server.metatrafficUnicastLocatorList.push_back(address);
  builtin.discovery_config.m_DiscoveryServers.push_back(server);
#endif
}

// Lets a participant send no descriptions of types (XTypes). With that of Fast DDS 3.1, Cyclone DDS 0.10 learns the
// fields of a type, but does not match readers and writers of types within types. Releases before 3 send none anyway.
inline void SendNoTypeInformation([[maybe_unused]] dds::DomainParticipantQos& qos)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  qos.properties().properties().emplace_back(dds::parameter_policy_type_propagation, "disabled");
#endif
}

// A participant of the domain, as its announcement describes it.
struct DiscoveredParticipant
{
  enum class Change
  {
    kPresent,  // the participant is new, or has changed
    kLeft,     // it said Leave
    kDropped   // it was silent for its lease
  };
  Change change;
  rtps::GuidPrefix_t prefix;
  std::string name;
  std::string user_data;
};

// Listens to the participants of a domain. Override OnParticipant; it is called in threads of Fast DDS.
class ParticipantListener : public dds::DomainParticipantListener
{
public:
  // A thread of Fast DDS calls it when a participant has come, changed, left or been silent for its lease.
  virtual void OnParticipant(const DiscoveredParticipant& participant) = 0;

#if SWARMANOID_FAST_DDS_MAJOR >= 3
  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryStatus status,
                                const dds::ParticipantBuiltinTopicData& about, bool& should_be_ignored) final
  {
    should_be_ignored = false;
    Tell<rtps::ParticipantDiscoveryStatus>(status, about.guid.guidPrefix, about.participant_name.to_string(),
                                           about.user_data.data_vec());
  }
#else
  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& found) final
  {
    Tell<rtps::ParticipantDiscoveryInfo>(found.status, found.info.m_guid.guidPrefix,
                                         found.info.m_participantName.to_string(), found.info.m_userData.data_vec());
  }
#endif

private:
  template <class Statuses, class Status, class Bytes>
  void Tell(Status status, const rtps::GuidPrefix_t& prefix, std::string name, const Bytes& user_data)
  {
    using Change = DiscoveredParticipant::Change;
    Change change = Change::kPresent;
    switch (status)
    {
      case Statuses::DISCOVERED_PARTICIPANT:
      case Statuses::CHANGED_QOS_PARTICIPANT:
        break;
      case Statuses::REMOVED_PARTICIPANT:
        change = Change::kLeft;
        break;
      case Statuses::DROPPED_PARTICIPANT:
        change = Change::kDropped;
        break;
      default:
        return;  // newer releases also report a participant that they were told to ignore
    }
    OnParticipant({change, prefix, std::move(name), {user_data.begin(), user_data.end()}});
  }
};

}  // namespace swarmanoid
