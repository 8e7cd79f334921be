// CAny: a value of any type, taken out by any_cast.
#pragma once

#include <memory>
#include <typeinfo>

namespace argos
{

// Not std::any, which controllers in the language of 2011 do not have.
class CAny
{
public:
  CAny() = default;
  template <class T>
  CAny(const T& value) : held_(std::make_shared<Held<T>>(value))
  {
  }
  CAny& swap(CAny& other)
  {
    held_.swap(other.held_);
    return *this;
  }
  bool IsEmpty() const { return held_ == nullptr; }
  // nullptr for another type than that which was put in.
  template <class T>
  const T* Find() const
  {
    const auto* held = dynamic_cast<const Held<T>*>(held_.get());
    return held == nullptr ? nullptr : &held->value;
  }

private:
  struct Holder
  {
    virtual ~Holder() = default;
  };
  template <class T>
  struct Held : Holder
  {
    explicit Held(const T& held) : value(held) {}
    T value;
  };

  // It never changes, so copies share it.
  std::shared_ptr<const Holder> held_;
};

// nullptr for another type than that which was put in.
template <class T>
const T* any_cast(const CAny* any)
{
  return any == nullptr ? nullptr : any->Find<T>();
}
// Throws std::bad_cast for another type than that which was put in.
template <class T>
T any_cast(const CAny& any)
{
  const T* value = any.Find<T>();
  if (value == nullptr) throw std::bad_cast();
  return *value;
}

}  // namespace argos
