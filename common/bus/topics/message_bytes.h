// Whole messages as payloads of DDS: four bytes for the encoding, then the fields. Used by the bus and the tests of its
// messages; does not depend on DDS.
#pragma once

#include "common/bus/topics/message_fields.h"

namespace swarmanoid
{

inline constexpr std::size_t kEncapsulation = 4;
inline constexpr char kEncodingXcdr1[kEncapsulation] = {0, 1, 0, 0};  // little-endian; the last two bytes are options

// Returns the payload without its first bytes. Throws BadMessage if it has another encoding.
inline std::span<const char> BodyOf(std::span<const char> payload)
{
  if (payload.size() < kEncapsulation || payload[0] != kEncodingXcdr1[0] || payload[1] != kEncodingXcdr1[1])
    throw BadMessage("it is not encoded in XCDR1, little-endian");
  return payload.subspan(kEncapsulation);
}

// Archives go through messages without changing them, unless they read.
template <class Archive, class Message>
void GoThrough(Archive& archive, const MessageHeader& header, const Message& message)
{
  Fields(archive, const_cast<MessageHeader&>(header));
  Fields(archive, const_cast<MessageHeader&>(header), const_cast<Message&>(message));
}
template <class Archive, class Message>
void GoThrough(Archive& archive, const Message& message)
{
  Fields(archive, const_cast<Message&>(message));
}

// Returns the bytes of a payload that is not sealed. `parts`: a header and a message of a tick, or another message.
// Throws BadMessage if a name in it cannot be sent.
template <class... Parts>
std::size_t PayloadSize(const Parts&... parts)
{
  CdrCounter counter{ByteCounter{}};
  GoThrough(counter, parts...);
  return kEncapsulation + counter.Size();
}

// `out` has room for PayloadSize(parts) bytes.
template <class... Parts>
void WritePayload(char* out, const Parts&... parts)
{
  std::memcpy(out, kEncodingXcdr1, kEncapsulation);
  CdrWriter writer{ByteMemory{out + kEncapsulation}};
  GoThrough(writer, parts...);
}

// The same, with SealedBytes of room, for a Sealer.
template <class... Parts>
void WriteUnsealed(char* out, const Parts&... parts)
{
  std::memcpy(out, kEncodingXcdr1, kEncapsulation);
  CdrWriter writer{ByteMemory{out + kSealedFieldsAt}};
  GoThrough(writer, parts...);
}

// Reads a message. Throws BadMessage; the message must not be used then.
template <class Message>
void ReadPayload(std::span<const char> payload, Message& message)
{
  CdrReader reader(BodyOf(payload));
  try
  {
    Fields(reader, message);
    reader.End();
  }
  catch (const BadMessage&)
  {
    // A sender with another protocol version is told so, whatever else is wrong.
    if (!reader.IsForeign()) throw;
  }
}

// Reads a message of a tick. `choose` returns its destination once the header is read, or nullptr to drop it. `check`
// throws BadMessage if the experiment does not allow it. Returns the destination.
template <class Message, class Choose, class Check>
Message* ReadTickPayload(std::span<const char> payload, MessageHeader& header, const Choose& choose, const Check& check)
{
  CdrReader reader(BodyOf(payload));
  Fields(reader, header);
  Message* place = choose(header);
  if (place == nullptr) return nullptr;
  Fields(reader, header, *place);
  reader.End();
  check(header, *place);
  return place;
}

}  // namespace swarmanoid
