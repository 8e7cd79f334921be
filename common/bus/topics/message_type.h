// Type support of all messages: converts between plain structs and payloads in one pass. No exception may reach DDS. An
// error of a payload is kept for the reader, which knows the sender.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "common/bus/dds/data_type.h"
#include "common/bus/topics/message_bytes.h"

namespace swarmanoid
{

template <class Message>
class MessageType : public DataType
{
public:
  // `payload_bytes`: the memory that is allocated before the first message.
  MessageType(std::size_t payload_bytes, bool keyed)
      : DataType(std::string("swarmanoid::wire::") + kTopicOf<Message>, payload_bytes, keyed)
  {
  }

protected:
  static std::span<const char> BytesOf(const Payload& payload)
  {
    return {reinterpret_cast<const char*>(payload.data), payload.length};
  }
  // `size`: the bytes of the payload before it is sealed. Without a sealer it stays in the clear.
  template <class... Parts>
  static bool WriteParts(Payload& payload, std::size_t size, Sealer* sealer, const WriterId& writer,
                         const Parts&... parts)
  {
    const std::size_t padding = sealer == nullptr ? 0 : PaddingOf(size);
    if (sealer != nullptr) size = SealedBytes(size);
    if (size > payload.max_size) return false;
    payload.encapsulation = CDR_LE;
    payload.length = static_cast<std::uint32_t>(size);
    char* const bytes = reinterpret_cast<char*>(payload.data);
    if (sealer == nullptr)
    {
      WritePayload(bytes, parts...);
      return true;
    }
    WriteUnsealed(bytes, parts...);
    std::memset(bytes + size - kCodeBytes - padding, 0, padding);
    sealer->Seal({bytes, size}, writer);
    return true;
  }
};

// ---- Messages of a tick ----

template <class Message>
struct HotWrite
{
  const MessageHeader* header;
  const Message* message;
  std::size_t size;          // of the payload before it is sealed
  Sealer* sealer = nullptr;  // nullptr: it stays in the clear
  WriterId writer{};
};

// Opens the sealed messages of a reader of a tick's messages.
struct HotOpener
{
  // The key of the run, and the opener of the topic. No key: messages come in the clear.
  std::optional<RunKey> key;
  Opener opener;
  std::vector<char> room;  // as large as the largest message that came
};

// A reader passes this to the type support. The destination of the message is chosen when its header is read.
template <class Message>
struct HotRead
{
  const typename HotSubscription<Message>::Handler* handler;
  MessageHeader header;
  Message* message = nullptr;  // nullptr: dropped
  std::string error;           // not empty: what is wrong with it
  HotOpener* opener = nullptr;
  std::optional<Opener::Opened> opened{};  // if it was sealed
  const char* refused = nullptr;           // why its sender is unknown
};

inline constexpr const char* kNoSeal =
    "it is not sealed by the key of this run: its sender is of another user, another run or another release, or was "
    "started without the key (--key)";
inline constexpr const char* kRepetition = "it is a repetition of a message that has come before";
inline constexpr const char* kOtherWriter = "it is a message of another writer of this run";

// The size has a bound that is chosen at run time, because data sharing needs one.
template <class Message>
class HotType : public MessageType<Message>
{
public:
  explicit HotType(std::size_t capacity) : MessageType<Message>(capacity, false) {}

  bool Write(const void* data, Payload& payload) const override
  {
    const auto& call = *static_cast<const HotWrite<Message>*>(data);
    return this->WriteParts(payload, call.size, call.sealer, call.writer, *call.header, *call.message);
  }

  bool Read(const Payload& payload, void* data) const override
  {
    auto& call = *static_cast<HotRead<Message>*>(data);
    call.message = nullptr;
    call.error.clear();
    call.refused = nullptr;
    call.opened.reset();
    std::span<const char> bytes = this->BytesOf(payload);
    if (call.opener != nullptr && call.opener->key)
    {
      if (!Unseal(bytes, call)) return true;
      bytes = call.opened->payload;
    }
    try
    {
      const auto check = [&](const MessageHeader& header, const Message& message)
      {
        if (call.handler->check) call.handler->check(header, message);
      };
      call.message = ReadTickPayload<Message>(bytes, call.header, call.handler->choose, check);
    }
    catch (const std::exception& error)
    {
      call.error = error.what();
    }
    return true;
  }

  std::size_t SizeOf(const void* data) const override
  {
    const auto& call = *static_cast<const HotWrite<Message>*>(data);
    return call.sealer == nullptr ? call.size : SealedBytes(call.size);
  }

  void* Make() const override { return new HotRead<Message>(); }
  void Delete(void* data) const override { delete static_cast<HotRead<Message>*>(data); }
  bool IsBounded() const override { return true; }

private:
  static bool Unseal(std::span<const char> bytes, HotRead<Message>& call)
  {
    HotOpener& by = *call.opener;
    try
    {
      call.opened = by.opener.Knows(bytes) ? by.opener.Open(bytes, by.room) : by.opener.OpenBy(*by.key, bytes, by.room);
    }
    catch (const std::exception& error)
    {
      call.error = error.what();
      return false;
    }
    if (!call.opened)
      call.refused = kNoSeal;
    else if (!by.opener.IsNew(*call.opened))
      call.refused = kRepetition;
    return call.refused == nullptr;
  }
};

// ---- All others ----

template <class Message>
struct ColdCall
{
  const Message* out = nullptr;          // to write
  std::size_t size = 0;                  // of its payload before it is sealed
  Sealer* sealer = nullptr;              // of what is written; none: it stays in the clear
  WriterId writer{};                     // the writer of that message
  Message* in = nullptr;                 // to read
  std::vector<char>* payload = nullptr;  // to read only later
  std::string error;                     // not empty: what is wrong with it
};

template <class Message>
class ColdType : public MessageType<Message>
{
public:
  ColdType() : MessageType<Message>(kFirstRoom, swarmanoid::KeyOf(Message()) != nullptr) {}

  bool Write(const void* data, Payload& payload) const override
  {
    const auto& call = *static_cast<const ColdCall<Message>*>(data);
    return this->WriteParts(payload, call.size, call.sealer, call.writer, *call.out);
  }

  bool Read(const Payload& payload, void* data) const override
  {
    auto& call = *static_cast<ColdCall<Message>*>(data);
    call.error.clear();
    if (call.payload != nullptr)
    {
      const std::span<const char> bytes = this->BytesOf(payload);
      call.payload->assign(bytes.begin(), bytes.end());
      return true;
    }
    try
    {
      ReadPayload(this->BytesOf(payload), *call.in);
    }
    catch (const std::exception& error)
    {
      call.error = error.what();
    }
    return true;
  }

  std::size_t SizeOf(const void* data) const override
  {
    const auto& call = *static_cast<const ColdCall<Message>*>(data);
    return call.sealer == nullptr ? call.size : SealedBytes(call.size);
  }

  // The MD5 of the key as big-endian XCDR1: keys that may be longer than 16 bytes are told so (DDSI-RTPS 9.6.3.8).
  bool KeyOf(const void* data, InstanceHandle& handle) const override
  {
    const auto& call = *static_cast<const ColdCall<Message>*>(data);
    const Message* const message = call.out != nullptr ? call.out : call.in;
    const std::string* key = message == nullptr ? nullptr : swarmanoid::KeyOf(*message);
    if (key == nullptr) return false;
    const auto length = static_cast<std::uint32_t>(key->size() + 1);
    const std::array<char, 4> big_endian{static_cast<char>(length >> 24U), static_cast<char>(length >> 16U),
                                         static_cast<char>(length >> 8U), static_cast<char>(length)};
    Md5 digest;
    digest.init();
    digest.update(big_endian.data(), 4);
    digest.update(key->c_str(), length);
    digest.finalize();
    for (std::size_t i = 0; i < 16; ++i) handle.value[i] = digest.digest[i];
    return true;
  }

  void* Make() const override { return static_cast<ColdCall<Message>*>(new OwnedCall()); }
  void Delete(void* data) const override { delete static_cast<OwnedCall*>(static_cast<ColdCall<Message>*>(data)); }

private:
  static constexpr std::size_t kFirstRoom = 1024;

  // DDS calls it to find the key of a message.
  struct OwnedCall : ColdCall<Message>
  {
    OwnedCall() { this->in = &message; }
    Message message;
  };
};

}  // namespace swarmanoid
