// A request about a running experiment: a verb and its named arguments. common/messages/control_verbs.h has the verbs
// and checks the arguments. The space server executes requests between two ticks. ControlRequest in
// idl/swarmanoid.idl is the message.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace swarmanoid
{

// The index of the alternative is the discriminator on the wire. Vectors hold poses: x, y, z in m, and perhaps alpha,
// beta, gamma in degrees.
using ControlValue = std::variant<std::string, std::int64_t, double, std::vector<double>>;

struct ControlArgument
{
  std::string name;
  ControlValue value;

  bool operator==(const ControlArgument&) const = default;
};

// A request without its sender. The arguments are in the order of the verb's parameters.
struct ControlOrder
{
  std::string verb;
  std::vector<ControlArgument> arguments{};

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

struct ControlRequestMessage : ControlOrder
{
  std::string client{};      // "host:pid" of the asking process; empty in a run of one process
  std::uint32_t number = 0;  // a client numbers its requests
  std::string user{};        // the name of the user whose process the client is
  std::uint64_t run = 0;     // the run that is asked; another run refuses the request
};

// The reply to a request that came after the end of the run.
inline std::string RunEndedText(std::uint64_t tick) { return "the run ended at tick " + std::to_string(tick); }

}  // namespace swarmanoid
