// Flat byte images of saved states: little-endian, raw IEEE bits, in a fixed order. Used by checkpoints of engines,
// controllers and the space.
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
  // The count (u64), then the elements.
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
  void PutText(std::string_view text) { PutArray(std::span<const char>(text.data(), text.size())); }

  const std::vector<char>& Bytes() const { return bytes_; }
  void Clear() { bytes_.clear(); }

private:
  std::vector<char> bytes_;
};

// Throws std::runtime_error if the image ends too early.
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
    const auto count = Get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) throw std::runtime_error("saved state: an array is longer than the state");
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), Take(count * sizeof(T)), count * sizeof(T));
    return values;
  }
  // The bytes of an array of such elements, where they are: not aligned.
  template <class T>
  requires std::is_trivially_copyable_v<T> std::span<const char> GetImage()
  {
    const auto count = Get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) throw std::runtime_error("saved state: an array is longer than the state");
    return {Take(count * sizeof(T)), count * sizeof(T)};
  }
  std::string GetText()
  {
    const auto characters = GetArray<char>();
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
