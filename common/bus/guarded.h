// Guarded: a value that several threads share, with its lock. The value can be reached only through the lock, so that
// no code can forget it.
#pragma once

#include <mutex>
#include <utility>

namespace swarmanoid
{

template <class Value>
class Guarded
{
public:
  // Holds the lock for as long as it lives.
  template <class Held>
  class Access
  {
  public:
    Access(std::mutex& mutex, Held& value) : lock_(mutex), value_(value) {}
    Held* operator->() const { return &value_; }
    Held& operator*() const { return value_; }

  private:
    std::unique_lock<std::mutex> lock_;
    Held& value_;
  };

  Guarded() = default;
  explicit Guarded(Value value) : value_(std::move(value)) {}

  Access<Value> Lock() { return {mutex_, value_}; }
  Access<const Value> Lock() const { return {mutex_, value_}; }

private:
  mutable std::mutex mutex_;
  Value value_;
};

}  // namespace swarmanoid
