// Memory that grows and is kept, for code that writes all bytes before it reads them. New bytes are not filled with
// zeros, as in a vector, and unwritten pages cost nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace swarmanoid
{

class ReusedMemory
{
public:
  ReusedMemory() = default;
  ReusedMemory(ReusedMemory&& other) noexcept : bytes_(std::move(other.bytes_)), size_(std::exchange(other.size_, 0)) {}
  ReusedMemory& operator=(ReusedMemory&& other) noexcept
  {
    std::swap(bytes_, other.bytes_);
    std::swap(size_, other.size_);
    return *this;
  }

  // Returns at least `size` bytes. The earlier bytes keep their values, but may move. Throws std::bad_alloc.
  char* AtLeast(std::size_t size)
  {
    if (size <= size_) return bytes_.get();
    const std::size_t grown = std::max(size, size_ + size_ / 2);
    void* const moved = std::realloc(bytes_.get(), grown);
    if (moved == nullptr) throw std::bad_alloc();
    static_cast<void>(bytes_.release());
    bytes_.reset(static_cast<char*>(moved));
    size_ = grown;
    return bytes_.get();
  }
  char* Bytes() { return bytes_.get(); }
  const char* Bytes() const { return bytes_.get(); }

private:
  struct Free
  {
    void operator()(char* bytes) const { std::free(bytes); }
  };

  std::unique_ptr<char, Free> bytes_;
  std::size_t size_ = 0;
};

}  // namespace swarmanoid
