// RawType: messages as bytes, for a participant that is no process of Swarmanoid.
#pragma once

#include <cstring>
#include <string>

#include "common/bus/dds/data_type.h"
#include "common/bus/topics/qos.h"

namespace swarmanoid::test
{

// A payload is the bytes of a std::string. `topic` may end with the id of a grant behind a slash: "View/1a2b3c4d".
class RawType : public DataType
{
public:
  explicit RawType(const std::string& topic)
      : DataType("swarmanoid::wire::" + topic.substr(0, topic.find('/')), 4096,
                 QosOf(topic.substr(0, topic.find('/'))).keyed)
  {
  }
  std::size_t SizeOf(const void* data) const override { return static_cast<const std::string*>(data)->size(); }
  bool Write(const void* data, Payload& payload) const override
  {
    const auto& bytes = *static_cast<const std::string*>(data);
    if (bytes.size() > payload.max_size) return false;
    std::memcpy(payload.data, bytes.data(), bytes.size());
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool Read(const Payload& payload, void* data) const override
  {
    static_cast<std::string*>(data)->assign(reinterpret_cast<const char*>(payload.data), payload.length);
    return true;
  }
  void* Make() const override { return new std::string(); }
  void Delete(void* data) const override { delete static_cast<std::string*>(data); }
  bool KeyOf(const void*, InstanceHandle& handle) const override
  {
    for (std::size_t k = 0; k < 16; ++k) handle.value[k] = 7;
    return true;
  }
};

}  // namespace swarmanoid::test
