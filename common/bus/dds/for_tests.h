// The parts of Fast DDS that only tests use.
#pragma once

#include "common/bus/dds/data_type.h"
#if SWARMANOID_FAST_DDS_MAJOR >= 3
#include <fastdds/LibrarySettings.hpp>
#else
#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#endif

namespace swarmanoid::test
{

// Participants of one process talk over the network, as those of two processes do, while an object of this class lives.
// Otherwise messages between them are read by the thread that writes them.
class SeparateProcesses
{
public:
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  SeparateProcesses()
  {
    dds::DomainParticipantFactory::get_instance()->get_library_settings(before_);
    auto settings = before_;
    settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
    dds::DomainParticipantFactory::get_instance()->set_library_settings(settings);
  }
  ~SeparateProcesses() { dds::DomainParticipantFactory::get_instance()->set_library_settings(before_); }
#else
  SeparateProcesses() : before_(Profiles::library_settings())
  {
    auto settings = before_;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    Profiles::library_settings(settings);
  }
  ~SeparateProcesses() { Profiles::library_settings(before_); }
#endif
  SeparateProcesses(const SeparateProcesses&) = delete;
  SeparateProcesses& operator=(const SeparateProcesses&) = delete;

private:
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  eprosima::fastdds::LibrarySettings before_;
#else
  using Profiles = eprosima::fastrtps::xmlparser::XMLProfileManager;
  const eprosima::fastrtps::LibrarySettingsAttributes before_;
#endif
};

// Calls of the types that fastddsgen wrote: a message from its payload and back, its key, and whether it has one.
template <class Type>
bool GeneratedRead(Type& type, Payload& payload, void* data)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return type.deserialize(payload, data);
#else
  return type.deserialize(&payload, data);
#endif
}

template <class Type>
bool GeneratedWrite(Type& type, void* data, Payload& payload)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return type.serialize(data, payload, dds::XCDR_DATA_REPRESENTATION);
#else
  return type.serialize(data, &payload);
#endif
}

template <class Type>
bool GeneratedKey(Type& type, void* data, InstanceHandle& handle)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return type.compute_key(data, handle, false);
#else
  return type.getKey(data, &handle, false);
#endif
}

inline bool IsKeyed(const dds::TopicDataType& type)
{
#if SWARMANOID_FAST_DDS_MAJOR >= 3
  return type.is_compute_key_provided;
#else
  return type.m_isGetKeyDefined;
#endif
}

}  // namespace swarmanoid::test
