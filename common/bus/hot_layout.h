// The bytes of the messages of a tick: the XCDR1 encoding of their IDL types, written and read as flat arrays. The
// order of the fields is that of idl/swarmanoid.idl, which puts every sequence where no padding is needed. Used by the
// bus alone.
#pragma once

#include <cstring>
#include <span>
#include <stdexcept>

#include "common/bus/messages.h"

namespace swarmanoid
{

inline constexpr std::uint32_t kFlagLastOrTerminate = 1;
inline constexpr std::uint32_t kFlagRepeated = 2;

template <class T>
inline constexpr const char* kTopicOf = nullptr;
template <>
inline constexpr const char* kTopicOf<SpaceState> = "SpaceState";
template <>
inline constexpr const char* kTopicOf<ControlCommands> = "ControlCommands";
template <>
inline constexpr const char* kTopicOf<EngineUpdate> = "EngineUpdate";
template <>
inline constexpr const char* kTopicOf<SensorFrame> = "SensorFrame";
template <>
inline constexpr const char* kTopicOf<DrawnMessage> = "Drawn";

template <class Archive>
void Fields(Archive& archive, SpaceState& message)
{
  archive.Array(message.poses);
  archive.Flags(message.last);
  archive.Array(message.attributes.values);
  archive.Array(message.attributes.slots);
  archive.Array(message.moved);
}

template <class Archive>
void Fields(Archive& archive, ControlCommands& message)
{
  bool unused = false;
  archive.Array(message.values);
  archive.Flags(unused);
  archive.Array(message.attributes.values);
  archive.Array(message.attributes.slots);
}

template <class Archive>
void Fields(Archive& archive, EngineUpdate& message)
{
  bool unused = false;
  archive.Array(message.poses);
  archive.Flags(unused);
  archive.Array(message.attributes.values);
  archive.Array(message.attributes.slots);
}

template <class Archive>
void Fields(Archive& archive, SensorFrame& message)
{
  archive.Array(message.values);
}

template <class Archive>
void Fields(Archive& archive, DrawnMessage& message)
{
  archive.Flags(message.terminate);
}

class SizeArchive
{
public:
  template <class T>
  void Array(const std::vector<T>& values)
  {
    size_ += sizeof(std::uint32_t) + values.size() * sizeof(T);
  }
  void Flags(bool) { size_ += sizeof(std::uint32_t); }
  std::size_t Size() const { return size_; }

private:
  std::size_t size_ = 20;  // run, tick, source
};

class WriteArchive
{
public:
  WriteArchive(char* out, const MessageHeader& header) : out_(out), repeated_(header.repeated)
  {
    Put(header.run);
    Put(header.tick);
    Put(header.source);
  }
  template <class T>
  void Array(const std::vector<T>& values)
  {
    Put(static_cast<std::uint32_t>(values.size()));
    if (!values.empty()) std::memcpy(out_, values.data(), values.size() * sizeof(T));
    out_ += values.size() * sizeof(T);
  }
  void Flags(bool first) { Put((first ? kFlagLastOrTerminate : 0U) | (repeated_ ? kFlagRepeated : 0U)); }

private:
  template <class T>
  void Put(const T& value)
  {
    std::memcpy(out_, &value, sizeof(T));
    out_ += sizeof(T);
  }

  char* out_;
  bool repeated_;
};

// Throws std::runtime_error where the message ends too early.
class ReadArchive
{
public:
  explicit ReadArchive(std::span<const char> bytes) : bytes_(bytes) {}

  MessageHeader Header()
  {
    MessageHeader header;
    Get(header.run);
    Get(header.tick);
    Get(header.source);
    return header;
  }
  template <class T>
  void Array(std::vector<T>& values)
  {
    std::uint32_t count = 0;
    Get(count);
    const char* from = Take(count * sizeof(T));
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), from, count * sizeof(T));
  }
  void Flags(bool& first)
  {
    std::uint32_t flags = 0;
    Get(flags);
    first = (flags & kFlagLastOrTerminate) != 0;
    repeated_ = (flags & kFlagRepeated) != 0;
  }
  bool Repeated() const { return repeated_; }

private:
  const char* Take(std::size_t count)
  {
    if (count > bytes_.size() - position_) throw std::runtime_error("a message ends too early");
    const char* start = bytes_.data() + position_;
    position_ += count;
    return start;
  }
  template <class T>
  void Get(T& value)
  {
    std::memcpy(&value, Take(sizeof(T)), sizeof(T));
  }

  std::span<const char> bytes_;
  std::size_t position_ = 0;
  bool repeated_ = false;
};

inline void SetHeader(SpaceState& message, const MessageHeader& header) { message.tick = header.tick; }
inline void SetHeader(ControlCommands& message, const MessageHeader& header)
{
  message.tick = header.tick;
  message.host = header.source;
}
inline void SetHeader(EngineUpdate& message, const MessageHeader& header)
{
  message.tick = header.tick;
  message.engine = header.source;
}
inline void SetHeader(SensorFrame& message, const MessageHeader& header)
{
  message.tick = header.tick;
  message.engine = header.source;
}
inline void SetHeader(DrawnMessage&, const MessageHeader&) {}

template <class Message>
std::size_t EncodedSize(const Message& message)
{
  SizeArchive size;
  Fields(size, const_cast<Message&>(message));
  return size.Size();
}

// `out` has EncodedSize(message) bytes.
template <class Message>
void Encode(const MessageHeader& header, const Message& message, char* out)
{
  WriteArchive archive(out, header);
  Fields(archive, const_cast<Message&>(message));
}

}  // namespace swarmanoid
