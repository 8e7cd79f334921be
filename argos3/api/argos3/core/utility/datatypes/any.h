// CAny: a value of any type, read by any_cast.
#pragma once

#include <memory>
#include <typeinfo>

namespace argos
{

// It is not std::any, which C++11 controllers lack.
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
  // Returns nullptr for a type other than the stored one.
  template <class T>
  const T* Find() const
  {
    if (held_ == nullptr || held_->Type() != typeid(T)) return nullptr;
    return &static_cast<const Held<T>*>(held_.get())->value;
  }

private:
  struct Holder
  {
    virtual ~Holder() = default;
    // Returns the type of the value.
    virtual const std::type_info& Type() const = 0;
  };
  template <class T>
  struct Held : Holder
  {
    explicit Held(const T& held) : value(held) {}
    const std::type_info& Type() const override { return typeid(T); }
    T value;
  };

  // The value never changes, so copies share it.
  std::shared_ptr<const Holder> held_;
};

// Returns nullptr for a type other than the stored one.
template <class T>
const T* any_cast(const CAny* any)
{
  return any == nullptr ? nullptr : any->Find<T>();
}
// Throws std::bad_cast for a type other than the stored one.
template <class T>
T any_cast(const CAny& any)
{
  const T* value = any.Find<T>();
  if (value == nullptr) throw std::bad_cast();
  return *value;
}

}  // namespace argos
