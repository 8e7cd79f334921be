// A type of messages, between plain structs and the payloads of DDS, with one set of functions for all releases of
// Fast DDS. Calls come in the threads that write, and in threads of Fast DDS.
#pragma once

#include "common/bus/dds/fast_dds.h"
#if SWARMANOID_FAST_DDS_MAJOR >= 3
#include <fastdds/utils/md5.hpp>
#else
#include <fastrtps/utils/md5.h>
#endif

#include <functional>

namespace swarmanoid
{

using Payload = rtps::SerializedPayload_t;
using InstanceHandle = rtps::InstanceHandle_t;

#if SWARMANOID_FAST_DDS_MAJOR >= 3
using Md5 = eprosima::fastdds::MD5;
#else
using Md5 = MD5;
#endif

class DataType : public dds::TopicDataType
{
public:
  // `most_bytes`: the size of the payload that is allocated before the first message. `keyed`: whether KeyOf finds
  // keys.
  DataType(const std::string& name, std::size_t most_bytes, bool keyed)
  {
#if SWARMANOID_FAST_DDS_MAJOR >= 3
    set_name(name);
    max_serialized_type_size = static_cast<std::uint32_t>(most_bytes);
    is_compute_key_provided = keyed;
#else
    setName(name.c_str());
    m_typeSize = static_cast<std::uint32_t>(most_bytes);
    m_isGetKeyDefined = keyed;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
#endif
  }

  // Returns the bytes of the payload that Write makes of `data`.
  virtual std::size_t SizeOf(const void* data) const = 0;
  // Writes `data` into the payload, which has room for its `max_size`. Returns false if that is not enough.
  virtual bool Write(const void* data, Payload& payload) const = 0;
  // Reads the payload into `data`. Must not throw; returns false for a message that cannot be read.
  virtual bool Read(const Payload& payload, void* data) const = 0;
  // Returns a new object that a message is read into.
  virtual void* Make() const = 0;
  // Destroys an object that Make returned.
  virtual void Delete(void* data) const = 0;
  // Fills in the instance that `data` belongs to. Returns false if the type has no keys.
  virtual bool KeyOf(const void*, InstanceHandle&) const { return false; }
  // Returns true for types whose messages never have more bytes than the constructor was told.
  virtual bool IsBounded() const { return false; }

  bool is_bounded() const final { return IsBounded(); }

#if SWARMANOID_FAST_DDS_MAJOR >= 3
  bool serialize(const void* const data, Payload& payload, dds::DataRepresentationId_t) final
  {
    return Write(data, payload);
  }
  bool deserialize(Payload& payload, void* data) final { return Read(payload, data); }
  std::uint32_t calculate_serialized_size(const void* const data, dds::DataRepresentationId_t) final
  {
    return static_cast<std::uint32_t>(SizeOf(data));
  }
  void* create_data() final { return Make(); }
  void delete_data(void* data) final { Delete(data); }
  bool compute_key(const void* const data, InstanceHandle& handle, bool) final { return KeyOf(data, handle); }
  bool compute_key(Payload& payload, InstanceHandle& handle, bool) final
  {
    void* const data = Make();
    const bool found = Read(payload, data) && KeyOf(data, handle);
    Delete(data);
    return found;
  }
  bool is_plain(dds::DataRepresentationId_t) const final { return false; }
#else
  bool serialize(void* data, Payload* payload) final { return Write(data, *payload); }
  bool deserialize(Payload* payload, void* data) final { return Read(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) final
  {
    return [this, data] { return static_cast<std::uint32_t>(SizeOf(data)); };
  }
  void* createData() final { return Make(); }
  void deleteData(void* data) final { Delete(data); }
  bool getKey(void* data, InstanceHandle* handle, bool) final { return KeyOf(data, *handle); }
  bool is_plain() const final { return false; }
#endif
};

}  // namespace swarmanoid
