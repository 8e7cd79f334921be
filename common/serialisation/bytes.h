// Flat byte images of saved states: little-endian, with raw IEEE bits, in a fixed order. Checkpoints of engines,
// controllers and the space use them.
#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace swarmanoid
{

class ByteWriter
{
public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void Put(const T& value)
  {
    const auto* bytes = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
  }
  // Appends the count (u64), then the elements.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void PutArray(std::span<const T> values)
  {
    Put(static_cast<std::uint64_t>(values.size()));
    const auto* bytes = reinterpret_cast<const char*>(values.data());
    bytes_.insert(bytes_.end(), bytes, bytes + values.size_bytes());
  }
  template <class T>
  void PutArray(const std::vector<T>& values)
  {
    PutArray(std::span<const T>(values));
  }
  // Appends value_of(0), value_of(1), ... as PutArray does.
  template <class ValueOf>
  void PutEach(std::size_t count, const ValueOf& value_of)
  {
    using Value = std::decay_t<decltype(value_of(std::size_t{0}))>;
    static_assert(std::is_trivially_copyable_v<Value>);
    Put(static_cast<std::uint64_t>(count));
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + count * sizeof(Value));
    for (std::size_t k = 0; k < count; ++k)
    {
      const Value value = value_of(k);
      std::memcpy(bytes_.data() + begin + k * sizeof(Value), &value, sizeof(Value));
    }
  }
  void PutText(std::string_view text) { PutArray(std::span<const char>(text.data(), text.size())); }

  const std::vector<char>& Bytes() const { return bytes_; }
  void Clear() { bytes_.clear(); }

private:
  std::vector<char> bytes_;
};

// Reads the images. Throws std::runtime_error if the image ends too early.
class ByteReader
{
public:
  explicit ByteReader(std::span<const char> bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T> T Get()
  {
    T value;
    std::memcpy(&value, Take(sizeof(T)), sizeof(T));
    return value;
  }
  template <class T>
  requires std::is_trivially_copyable_v<T> std::vector<T> GetArray()
  {
    std::vector<T> values;
    GetArray(values);
    return values;
  }
  // Reads into existing memory.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void GetArray(std::vector<T>& values)
  {
    const std::span<const char> image = GetImage<T>();
    values.resize(image.size() / sizeof(T));
    if (!image.empty()) std::memcpy(values.data(), image.data(), image.size());
  }
  // Returns the bytes of an array of such elements in place, not aligned.
  template <class T>
  requires std::is_trivially_copyable_v<T> std::span<const char> GetImage()
  {
    const auto count = Get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) throw std::runtime_error("saved state: an array is longer than the state");
    return {Take(count * sizeof(T)), count * sizeof(T)};
  }
  std::string GetText()
  {
    const std::span<const char> characters = GetImage<char>();
    return {characters.begin(), characters.end()};
  }
  bool AtEnd() const { return position_ == bytes_.size(); }

private:
  const char* Take(std::size_t count)
  {
    if (count > bytes_.size() - position_) throw std::runtime_error("saved state: it ends too early");
    const char* start = bytes_.data() + position_;
    position_ += count;
    return start;
  }

  std::span<const char> bytes_;
  std::size_t position_ = 0;
};

}  // namespace swarmanoid
