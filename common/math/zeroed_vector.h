// Arrays that are mostly zero. Elements that were never written take no memory, since the system provides a page at the
// first write. Some systems provide one also at the first read, so known zeros are not read.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace swarmanoid
{

// ZeroedVector: a vector of numbers.
template <class T>
class ZeroedVector
{
  static_assert(std::is_arithmetic_v<T>);

public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  ZeroedVector() = default;
  explicit ZeroedVector(std::size_t count, T value = T{}) { resize(count, value); }
  ZeroedVector(const ZeroedVector& other) { *this = other; }
  ZeroedVector(ZeroedVector&& other) noexcept { swap(other); }
  ZeroedVector& operator=(const ZeroedVector& other)
  {
    if (this == &other) return *this;
    clear();
    resize(other.size_);
    CopyFrom(other);
    return *this;
  }
  ZeroedVector& operator=(ZeroedVector&& other) noexcept
  {
    swap(other);
    return *this;
  }
  ~ZeroedVector() = default;

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t place) { return data_[place]; }
  const T& operator[](std::size_t place) const { return data_[place]; }
  iterator begin() { return data_.get(); }
  iterator end() { return data_.get() + size_; }
  const_iterator begin() const { return data_.get(); }
  const_iterator end() const { return data_.get() + size_; }

  void clear() { size_ = 0; }
  void reserve(std::size_t count)
  {
    if (count > capacity_) Move(count);
  }
  void resize(std::size_t count, T value = T{})
  {
    if (count > capacity_) Move(std::max(count, 2 * capacity_));
    if (count > size_)
    {
      // Older values may stay in the elements up to used_.
      if (!IsZero(value))
        std::fill(begin() + size_, begin() + count, value);
      else
        for (std::size_t place = size_; place < std::min(count, used_); ++place)
          if (!IsZero(data_[place])) data_[place] = 0;
    }
    size_ = count;
    used_ = std::max(used_, size_);
  }
  void assign(std::size_t count, T value)
  {
    clear();
    resize(count, value);
  }
  void push_back(T value) { resize(size_ + 1, value); }
  void shrink_to_fit()
  {
    if (capacity_ > size_) Move(size_);
  }
  void swap(ZeroedVector& other) noexcept
  {
    data_.swap(other.data_);
    std::swap(size_, other.size_);
    std::swap(used_, other.used_);
    std::swap(capacity_, other.capacity_);
  }

  // Compares bits: -0.0 is not zero.
  static bool IsZero(T value)
  {
    const T zero{};
    return std::memcmp(&value, &zero, sizeof(T)) == 0;
  }

private:
  struct Free
  {
    void operator()(T* memory) const { std::free(memory); }
  };

  // Copies from a vector that is not shorter, if all elements here are zero.
  void CopyFrom(const ZeroedVector& other)
  {
    for (std::size_t place = 0; place < size_; ++place)
      if (!IsZero(other[place])) data_[place] = other[place];
  }
  void Move(std::size_t capacity)
  {
    ZeroedVector moved;
    if (capacity > 0)
    {
      moved.data_.reset(static_cast<T*>(std::calloc(capacity, sizeof(T))));
      if (moved.data_ == nullptr) throw std::bad_alloc();
    }
    moved.size_ = moved.used_ = size_;
    moved.capacity_ = capacity;
    moved.CopyFrom(*this);
    swap(moved);
  }

  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
  std::size_t used_ = 0;  // the elements from here on were never written
  std::size_t capacity_ = 0;
};

// A ZeroedVector that also records which pages were written, so that other pages are never read.
template <class T>
class SparseVector
{
public:
  std::size_t size() const { return values_.size(); }
  void reserve(std::size_t count) { values_.reserve(count); }
  void push_back(T value) { resize(size() + 1, value); }
  void resize(std::size_t count, T value = T{})
  {
    std::size_t place = values_.size();
    values_.resize(count);
    written_.resize((count + kPage - 1) / kPage);
    if (!ZeroedVector<T>::IsZero(value))
      for (; place < count; ++place) Set(place, value);
  }
  void Set(std::size_t place, T value)
  {
    std::uint8_t& written = written_[place / kPage];
    if (written == 0 && ZeroedVector<T>::IsZero(value)) return;
    written = 1;
    values_[place] = value;
  }
  T operator[](std::size_t place) const { return written_[place / kPage] != 0 ? values_[place] : T{}; }
  // Returns a part. Unwritten pages come from a shared page of zeros; parts longer than a page are returned in place.
  std::span<const T> Part(std::size_t first, std::size_t count) const
  {
    const bool is_here =
        count > kPage || (count > 0 && (written_[first / kPage] != 0 || written_[(first + count - 1) / kPage] != 0));
    return {is_here ? values_.data() + first : kZeros.data(), count};
  }
  // Reading all of these makes them take memory.
  std::span<const T> Values() const { return {values_.data(), values_.size()}; }
  // Calls visit(span) with the first `count` numbers, run by run.
  template <class Visit>
  void VisitRuns(std::size_t count, Visit&& visit) const
  {
    for (std::size_t from = 0, to = 0; from < count; from = to)
    {
      const bool is_written = written_[from / kPage] != 0;
      to = from + kPage;
      while (is_written && to < count && written_[to / kPage] != 0) to += kPage;
      to = std::min(to, count);
      visit(std::span<const T>(is_written ? values_.data() + from : kZeros.data(), to - from));
    }
  }

private:
  static constexpr std::size_t kPage = 4096 / sizeof(T);
  static constexpr std::array<T, kPage> kZeros{};

  ZeroedVector<T> values_;
  std::vector<std::uint8_t> written_;  // by page
};

}  // namespace swarmanoid
