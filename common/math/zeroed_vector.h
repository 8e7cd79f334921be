// Vectors for large arrays that stay zero for the most part. What was never written takes no memory: the system gives a
// page when something is written into it, and shows zeros until then.
#pragma once

#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace swarmanoid
{

template <class T>
struct ZeroedAllocator
{
  static_assert(std::is_arithmetic_v<T>);
  using value_type = T;

  ZeroedAllocator() = default;
  template <class U>
  ZeroedAllocator(const ZeroedAllocator<U>&) noexcept
  {
  }

  T* allocate(std::size_t count)
  {
    void* const memory = std::calloc(count, sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) noexcept { std::free(memory); }
  // Looks first: reading a page that was never written takes none. What a vector had there before may be left.
  void construct(T* place, const T& value = T{}) noexcept
  {
    if (std::memcmp(place, &value, sizeof(T)) != 0) *place = value;
  }

  friend bool operator==(const ZeroedAllocator&, const ZeroedAllocator&) { return true; }
};

// resize(n) writes nothing where zeros are.
template <class T>
using ZeroedVector = std::vector<T, ZeroedAllocator<T>>;

}  // namespace swarmanoid
