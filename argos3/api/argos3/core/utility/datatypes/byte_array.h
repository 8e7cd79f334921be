// CByteArray: bytes of a message. Numbers are packed in network order, texts with a final zero.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>
#include <argos3/core/utility/datatypes/datatypes.h>

#include <type_traits>

namespace argos
{

class CByteArray
{
public:
  CByteArray() = default;
  CByteArray(size_t size, UInt8 value = 0) : bytes_(size, value) {}
  CByteArray(const UInt8* buffer, size_t size) : bytes_(buffer, buffer + size) {}

  size_t Size() const { return bytes_.size(); }
  bool Empty() const { return bytes_.empty(); }
  void Clear() { bytes_.clear(); }
  void Swap(CByteArray& other) { bytes_.swap(other.bytes_); }
  void Resize(size_t size, UInt8 value = 0) { bytes_.resize(size, value); }
  void Zero() { std::fill(bytes_.begin(), bytes_.end(), UInt8{0}); }
  // Returns nullptr if it is empty.
  const UInt8* ToCArray() const { return Empty() ? nullptr : bytes_.data(); }
  UInt8* ToCArray() { return Empty() ? nullptr : bytes_.data(); }
  // Throw CARGoSException beyond the end.
  UInt8& operator[](size_t index) { return bytes_[Checked(index)]; }
  UInt8 operator[](size_t index) const { return bytes_[Checked(index)]; }
  bool operator==(const CByteArray& other) const { return bytes_ == other.bytes_; }
  bool operator!=(const CByteArray& other) const { return !(*this == other); }

  CByteArray& AddBuffer(const UInt8* buffer, size_t size)
  {
    bytes_.insert(bytes_.end(), buffer, buffer + size);
    return *this;
  }
  // Moves that many bytes from the front into `buffer`. Throws CARGoSException if there are fewer.
  CByteArray& FetchBuffer(UInt8* buffer, size_t size)
  {
    if (size > Size()) THROW_ARGOSEXCEPTION("a byte array of " << Size() << " bytes is asked for " << size);
    std::copy_n(bytes_.begin(), size, buffer);
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(size));
    return *this;
  }
  // Removes the first `size` bytes.
  CByteArray& PopFront(size_t size)
  {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(size, Size())));
    return *this;
  }

  // Returns a copy of the bytes from `from` up to the one before `to`, -1 for all, which the caller deletes. Throws
  // CARGoSException if `from` is beyond the end.
  CByteArray* operator()(size_t from, ssize_t to = -1) const
  {
    const size_t end = to < 0 ? Size() : std::min(static_cast<size_t>(to), Size());
    if (from >= Size() || from > end) THROW_ARGOSEXCEPTION("bytes from " << from << " of a byte array of " << end);
    return new CByteArray(bytes_.data() + from, end - from);
  }

  // Removes a value from the front and returns it.
  template <class T>
  T PopFront()
  {
    T value;
    *this >> value;
    return value;
  }

  // Appends whole numbers and floating-point numbers by their bits, highest byte first.
  template <class T, typename std::enable_if<std::is_arithmetic<T>::value, int>::type = 0>
  CByteArray& operator<<(T value)
  {
    UInt8 raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof value);
    if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) std::reverse(raw, raw + sizeof(T));
    return AddBuffer(raw, sizeof(T));
  }
  template <class T, typename std::enable_if<std::is_arithmetic<T>::value, int>::type = 0>
  CByteArray& operator>>(T& value)
  {
    UInt8 raw[sizeof(T)];
    FetchBuffer(raw, sizeof(T));
    if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) std::reverse(raw, raw + sizeof(T));
    std::memcpy(&value, raw, sizeof value);
    return *this;
  }
  // Texts end with a zero.
  CByteArray& operator<<(const std::string& text)
  {
    return AddBuffer(reinterpret_cast<const UInt8*>(text.c_str()), text.size() + 1);
  }
  CByteArray& operator>>(std::string& text)
  {
    const auto end = std::find(bytes_.begin(), bytes_.end(), UInt8{0});
    if (end == bytes_.end()) THROW_ARGOSEXCEPTION("a byte array has no text");
    text.assign(bytes_.begin(), end);
    return PopFront(text.size() + 1);
  }

  friend std::ostream& operator<<(std::ostream& stream, const CByteArray& array)
  {
    for (size_t i = 0; i < array.Size(); ++i) stream << (i == 0 ? "" : " ") << int{array.bytes_[i]};
    return stream;
  }

private:
  size_t Checked(size_t index) const
  {
    if (index >= Size()) THROW_ARGOSEXCEPTION("byte " << index << " of a byte array of " << Size());
    return index;
  }

  std::vector<UInt8> bytes_;
};

}  // namespace argos
