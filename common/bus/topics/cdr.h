// The bytes of messages: XCDR1, little-endian, as idl/swarmanoid.idl defines them. Three archives visit the fields of a
// message (idl/message_fields.h): one counts its bytes, one writes and one reads them. Every value is checked before it
// is used or memory is allocated for it. An invalid value throws BadMessage with the name of the field. Used only by
// the bus; does not depend on DDS.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "common/bus/bus.h"
#include "common/bus/security/seal.h"
#include "common/bus/topics/pose_columns.h"
#include "common/configuration/shown_text.h"
#include "idl/constants.h"

namespace swarmanoid
{

static_assert(std::endian::native == std::endian::little, "arrays are copied to the wire as they are in memory");

[[noreturn]] void RefuseField(const char* field, const std::string& why);
[[noreturn]] void RefuseName(const char* field, const std::string& name);
[[noreturn]] void RefuseLength(const char* field, std::size_t count, std::size_t bytes, std::size_t left);

// Visits what a field contains. Errors name the field before the inner one: "robots.sensors.type".
template <class Visit>
void Inside(const char* field, const Visit& visit)
{
  try
  {
    visit();
  }
  catch (const BadMessage& error)
  {
    throw BadMessage(std::string(field) + "." + error.what());
  }
}

// One bit of a message's flags.
struct FlagBit
{
  std::uint32_t bit;
  bool* value;
};

struct ByteCounter
{
  void Put(const void*, std::size_t count) { at += count; }
  void Pad(std::size_t count) { at += count; }
  std::size_t at = 0;
};

struct ByteMemory
{
  void Put(const void* bytes, std::size_t count)
  {
    if (count > 0) std::memcpy(out + at, bytes, count);
    at += count;
  }
  void Pad(std::size_t count)
  {
    std::memset(out + at, 0, count);
    at += count;
  }
  char* out;
  std::size_t at = 0;
};

// Counts or writes the fields.
template <class Bytes>
class CdrOutput
{
public:
  static constexpr bool kReads = false;

  explicit CdrOutput(Bytes bytes) : bytes_(bytes) {}
  std::size_t Size() const { return bytes_.at; }

  void Version(const char*, const std::uint32_t& value) { Put(value); }
  template <class T>
  void Integer(const char*, const T& value)
  {
    Put(value);
  }
  void Signed(const char*, const std::int64_t& value) { Put(value); }
  // The value has 16 bits on the wire.
  void Short(const char*, const std::uint32_t& value) { Put(static_cast<std::uint16_t>(value)); }
  void Constant(const char*, std::uint32_t value) { Put(value); }
  template <class Enum>
  void Choice(const char*, const Enum& value, Enum)
  {
    Put(static_cast<std::uint32_t>(value));
  }
  void Flags(const char*, std::initializer_list<FlagBit> flags, std::uint32_t others = 0)
  {
    std::uint32_t bits = others;
    for (const FlagBit& flag : flags) bits |= *flag.value ? flag.bit : 0U;
    Put(bits);
  }
  void Bool(const char*, const bool& value) { Put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void Number(const char*, const double& value) { Put(value); }
  void Measured(const char*, const double& value) { Put(value); }

  void Exact(const char*, const std::string& text) { String(text); }
  void Line(const char* field, const std::string& text)
  {
    if (text.size() > kLongestName || !IsShowableLine(text)) RefuseName(field, text);
    String(text);
  }
  void Lines(const char*, const std::string& text)
  {
    if (text.size() > kLongestText || !IsShowable(text)) return String(Showable(text, kLongestText));
    String(text);
  }
  template <class T>
  void Array(const char*, const std::vector<T>& values)
  {
    Put(static_cast<std::uint32_t>(values.size()));
    if (values.empty()) return;
    Align(sizeof(T));
    bytes_.Put(values.data(), values.size() * sizeof(T));
  }
  // A column in `uniform` has only its first number.
  void Columns(const std::vector<double>& poses, std::uint32_t uniform)
  {
    const std::size_t entities = poses.size() / kPoseColumns;
    const auto single = static_cast<std::size_t>(std::popcount(uniform));
    Put(static_cast<std::uint32_t>(poses.size() - single * (entities - 1)));
    if (poses.empty()) return;
    Align(sizeof(double));
    if (uniform == 0) return bytes_.Put(poses.data(), poses.size() * sizeof(double));
    for (std::size_t k = 0; k < kPoseColumns; ++k)
      bytes_.Put(poses.data() + k * entities, (uniform >> k & 1U ? 1 : entities) * sizeof(double));
  }
  void LinesList(const char* field, const std::vector<std::string>& texts)
  {
    Put(static_cast<std::uint32_t>(texts.size()));
    for (const std::string& text : texts) Lines(field, text);
  }
  template <class T>
  void List(const char* field, std::vector<T>& list)
  {
    Put(static_cast<std::uint32_t>(list.size()));
    Inside(field,
           [&]
           {
             for (T& item : list) Fields(*this, item);
           });
  }
  template <class T>
  void Struct(const char* field, T& value)
  {
    Inside(field, [&] { Fields(*this, value); });
  }
  // The kind of a union.
  template <class Variant>
  void Alternative(const char*, const Variant& value)
  {
    Put(static_cast<std::uint32_t>(value.index()));
  }

private:
  void Align(std::size_t size) { bytes_.Pad((size - bytes_.at % size) % size); }
  template <class T>
  void Put(const T& value)
  {
    Align(sizeof(T));
    bytes_.Put(&value, sizeof(T));
  }
  void String(std::string_view text)
  {
    Put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.Put(text.data(), text.size());
    bytes_.Put("", 1);
  }

  Bytes bytes_;
};

using CdrCounter = CdrOutput<ByteCounter>;
using CdrWriter = CdrOutput<ByteMemory>;

class CdrReader
{
public:
  static constexpr bool kReads = true;

  explicit CdrReader(std::span<const char> bytes) : bytes_(bytes) {}

  // Only padding may be left.
  void End() const
  {
    if (bytes_.size() - at_ > 3) RefuseField("end", "more bytes follow than the message has");
  }
  // Returns whether the message has another protocol version, so that the rest cannot be interpreted.
  bool IsForeign() const { return foreign_; }

  void Version(const char* field, std::uint32_t& value)
  {
    Integer(field, value);
    foreign_ = value != kProtocolVersion;
  }
  template <class T>
  void Integer(const char* field, T& value)
  {
    static_assert(std::is_same_v<T, std::uint32_t> || std::is_same_v<T, std::uint64_t>);
    Get(field, value);
  }
  void Signed(const char* field, std::int64_t& value) { Get(field, value); }
  void Short(const char* field, std::uint32_t& value)
  {
    std::uint16_t bits = 0;
    Get(field, bits);
    value = bits;
  }
  void Constant(const char* field, std::uint32_t wanted)
  {
    std::uint32_t value = 0;
    Get(field, value);
    if (value != wanted) RefuseField(field, "it is " + std::to_string(value) + ", not " + std::to_string(wanted));
  }
  // The value is from 1 to `last`.
  template <class Enum>
  void Choice(const char* field, Enum& value, Enum last)
  {
    std::uint32_t number = 0;
    Get(field, number);
    if (number < 1 || number > static_cast<std::uint32_t>(last))
      RefuseField(field, "there is no such value as " + std::to_string(number));
    value = static_cast<Enum>(number);
  }
  // Reads the flags. Returns the bits of `others` that are set.
  std::uint32_t Flags(const char* field, std::initializer_list<FlagBit> flags, std::uint32_t others = 0)
  {
    std::uint32_t bits = 0;
    Get(field, bits);
    for (const FlagBit& flag : flags)
    {
      *flag.value = (bits & flag.bit) != 0;
      bits &= ~flag.bit;
    }
    if ((bits & ~others) != 0) RefuseField(field, "bits are set that mean nothing");
    return bits;
  }
  void Bool(const char* field, bool& value)
  {
    std::uint8_t byte = 0;
    Get(field, byte);
    if (byte > 1) RefuseField(field, "it is neither true nor false");
    value = byte == 1;
  }
  void Number(const char* field, double& value)
  {
    Get(field, value);
    if (!std::isfinite(value)) RefuseField(field, "it is not finite");
  }
  void Measured(const char* field, double& value) { Get(field, value); }

  void Exact(const char* field, std::string& text) { text = String(field); }
  void Line(const char* field, std::string& text)
  {
    Bounded(field, text, kLongestName);
    if (!IsShowableLine(text)) RefuseField(field, "it is no UTF-8 text, or has control characters");
  }
  void Lines(const char* field, std::string& text)
  {
    Bounded(field, text, kLongestText);
    if (!IsShowable(text)) RefuseField(field, "it is no UTF-8 text, or has control characters");
  }
  // Reads the flags behind the poses, too.
  void Poses(const char* field, std::vector<double>& poses, std::initializer_list<FlagBit> flags)
  {
    std::uint32_t count = 0;
    const char* const numbers = Numbers<double>(field, count);
    constexpr std::uint32_t kUniform = ((1U << kPoseColumns) - 1) * kFlagUniformX;
    const std::uint32_t uniform = Flags("flags", flags, kUniform) / kFlagUniformX;
    const ColumnMistake mistake = SpreadColumns(numbers, count, uniform, poses);
    if (mistake == ColumnMistake::kLength) RefuseField(field, "they are not as many as the flags say");
    if (mistake == ColumnMistake::kNotFinite) RefuseField(field, "a number is not finite");
  }
  template <class T>
  void Array(const char* field, std::vector<T>& values)
  {
    std::uint32_t count = 0;
    const char* const from = Numbers<T>(field, count);
    values.resize(count);
    if (count == 0) return;
    if constexpr (std::is_same_v<T, double>)
    {
      if (!CopyFinite(values.data(), from, count)) RefuseField(field, "a number is not finite");
    }
    else
      std::memcpy(values.data(), from, count * sizeof(T));
  }
  void LinesList(const char* field, std::vector<std::string>& texts)
  {
    Resize(field, texts);
    for (std::string& text : texts) Lines(field, text);
  }
  template <class T>
  void List(const char* field, std::vector<T>& list)
  {
    Resize(field, list);
    Inside(field,
           [&]
           {
             for (T& item : list) Fields(*this, item);
           });
  }
  template <class T>
  void Struct(const char* field, T& value)
  {
    Inside(field, [&] { Fields(*this, value); });
  }
  template <class... T>
  void Alternative(const char* field, std::variant<T...>& value)
  {
    std::uint32_t kind = 0;
    Get(field, kind);
    if (kind >= sizeof...(T)) RefuseField(field, "there is no such kind of value");
    const std::variant<T...> kinds[] = {T()...};
    value = kinds[kind];
  }

private:
  void Align(const char* field, std::size_t size)
  {
    const std::size_t padding = (size - at_ % size) % size;
    if (padding > bytes_.size() - at_) RefuseField(field, "the message ends before it");
    at_ += padding;
  }
  template <class T>
  void Get(const char* field, T& value)
  {
    Align(field, sizeof(T));
    if (sizeof(T) > bytes_.size() - at_) RefuseField(field, "the message ends before it");
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
  }
  template <class T>
  void Resize(const char* field, std::vector<T>& list)
  {
    constexpr std::size_t kLeast = 4;  // bytes of an item: each starts with a number or a text
    const std::uint32_t count = Count(field);
    if (count > (bytes_.size() - at_) / kLeast) RefuseLength(field, count, kLeast, bytes_.size() - at_);
    list.resize(count);
  }
  // Returns the place of an array, whose numbers are to be copied. `count`: how many there are.
  template <class T>
  const char* Numbers(const char* field, std::uint32_t& count)
  {
    count = Count(field);
    if (count > 0) Align(field, sizeof(T));
    if (count > (bytes_.size() - at_) / sizeof(T)) RefuseLength(field, count, sizeof(T), bytes_.size() - at_);
    const char* const from = bytes_.data() + at_;
    at_ += count * sizeof(T);
    return from;
  }
  std::uint32_t Count(const char* field)
  {
    std::uint32_t count = 0;
    Get(field, count);
    return count;
  }
  std::string_view String(const char* field)
  {
    const std::uint32_t count = Count(field);  // with the zero at its end
    if (count > bytes_.size() - at_) RefuseLength(field, count, 1, bytes_.size() - at_);
    if (count == 0) return {};
    const std::string_view text(bytes_.data() + at_, count - 1);
    if (bytes_[at_ + count - 1] != '\0' || text.find('\0') != std::string_view::npos)
      RefuseField(field, "the text does not end where it says");
    at_ += count;
    return text;
  }
  void Bounded(const char* field, std::string& text, std::size_t most)
  {
    const std::string_view given = String(field);
    if (given.size() > most) RefuseLength(field, given.size(), 1, most);
    text = given;
  }

  std::span<const char> bytes_;
  std::size_t at_ = 0;
  bool foreign_ = false;
};

}  // namespace swarmanoid
