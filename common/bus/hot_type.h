// Type support of the messages of a tick, written by hand: it copies between the arrays of a role and the bytes on the
// wire (hot_layout.h) in one pass, and is bounded by a capacity chosen at run time, which data sharing asks for.
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <functional>
#include <string>

#include "common/bus/hot_layout.h"

namespace swarmanoid
{

template <class Message>
struct HotWrite
{
  const MessageHeader* header;
  const Message* message;
};

// What a reader hands to the type support: where the message goes is decided when its header is known.
template <class Message>
struct HotRead
{
  const std::function<Message*(const MessageHeader&)>* choose;
  MessageHeader header;
  Message* message = nullptr;  // nullptr: dropped
};

template <class Message>
class HotType : public eprosima::fastdds::dds::TopicDataType
{
public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  static constexpr std::uint32_t kEncapsulation = 4;

  explicit HotType(std::size_t capacity)
  {
    setName((std::string("swarmanoid::wire::") + kTopicOf<Message>).c_str());
    m_typeSize = static_cast<std::uint32_t>(capacity) + kEncapsulation;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, Payload* payload) override
  {
    const auto& call = *static_cast<const HotWrite<Message>*>(data);
    const std::size_t length = kEncapsulation + EncodedSize(*call.message);
    if (length > payload->max_size) return false;
    payload->encapsulation = CDR_LE;
    payload->data[0] = 0;
    payload->data[1] = 1;
    payload->data[2] = 0;
    payload->data[3] = 0;
    Encode(*call.header, *call.message, reinterpret_cast<char*>(payload->data) + kEncapsulation);
    payload->length = static_cast<std::uint32_t>(length);
    return true;
  }

  bool deserialize(Payload* payload, void* data) override
  {
    auto& call = *static_cast<HotRead<Message>*>(data);
    call.message = nullptr;
    if (payload->length < kEncapsulation || payload->data[1] != 1) return false;
    try
    {
      ReadArchive archive(
          {reinterpret_cast<const char*>(payload->data) + kEncapsulation, payload->length - kEncapsulation});
      call.header = archive.Header();
      Message* place = (*call.choose)(call.header);
      if (place == nullptr) return true;
      SetHeader(*place, call.header);
      Fields(archive, *place);
      call.header.repeated = archive.Repeated();
      call.message = place;
      return true;
    }
    catch (const std::runtime_error&)
    {
      return false;
    }
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override
  {
    const Message* message = static_cast<const HotWrite<Message>*>(data)->message;
    return [message] { return static_cast<std::uint32_t>(kEncapsulation + EncodedSize(*message)); };
  }

  void* createData() override { return new HotRead<Message>(); }
  void deleteData(void* data) override { delete static_cast<HotRead<Message>*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
  bool is_bounded() const override { return true; }
  bool is_plain() const override { return false; }
};

}  // namespace swarmanoid
