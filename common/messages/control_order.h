// The content of a request about a running experiment: a verb and its named arguments. common/messages/control_verbs.h
// has the verbs and checks the arguments. The space server executes requests between two ticks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "idl/verb_and_arguments.h"

namespace swarmanoid
{

// A request without its sender.
struct ControlOrder : VerbAndArguments
{
  bool operator==(const ControlOrder&) const = default;

  // Returns nullptr if there is no argument of that name and type.
  template <class T>
  const T* Find(std::string_view name) const
  {
    for (const ControlArgument& argument : arguments)
      if (argument.name == name) return std::get_if<T>(&argument.value);
    return nullptr;
  }
  // Returns the argument, or `otherwise` if it was left out.
  template <class T>
  T Get(std::string_view name, T otherwise = {}) const
  {
    const T* const value = Find<T>(name);
    return value == nullptr ? otherwise : *value;
  }
  // Replaces the argument, or adds it.
  void Set(const std::string& name, ControlValue value)
  {
    for (ControlArgument& argument : arguments)
      if (argument.name == name) return argument.value = std::move(value), void();
    arguments.push_back({name, std::move(value)});
  }
};

// The reply to a request that came after the end of the run.
inline std::string RunEndedText(std::uint64_t tick) { return "the run ended at tick " + std::to_string(tick); }

}  // namespace swarmanoid
