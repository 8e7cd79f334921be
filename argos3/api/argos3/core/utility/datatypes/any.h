// CAny: a value of any type, taken out by any_cast.
#pragma once

#include <any>
#include <utility>

namespace argos
{

class CAny
{
public:
  CAny() = default;
  template <class T>
  CAny(const T& value) : value_(value)
  {
  }
  bool IsEmpty() const { return !value_.has_value(); }
  const std::any& Value() const { return value_; }

private:
  std::any value_;
};

// Throws std::bad_any_cast for another type than that which was put in.
template <class T>
T any_cast(const CAny& any)
{
  return std::any_cast<T>(any.Value());
}

}  // namespace argos
