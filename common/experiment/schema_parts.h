// Functions for writing the tables of experiment files, and the part of <arena>. For schema*.cpp only.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/schema.h"

namespace swarmanoid
{

inline constexpr double kMostMetres = 1e6;
inline constexpr double kMostDegrees = 1e5;

inline ParameterSpec OneOf(ParameterSpec spec, std::vector<std::string> choices)
{
  spec.choices = std::move(choices);
  return spec;
}

inline ParameterSpec Id(std::string description)
{
  return {"id", ParameterType::kText, "", std::nullopt, std::move(description) + " Letters, digits and _ . : -"};
}

inline ParameterSpec Within(ParameterSpec spec, double minimum, double maximum)
{
  spec.minimum = minimum;
  spec.maximum = maximum;
  return spec;
}
inline ParameterSpec Place(ParameterSpec spec) { return Within(std::move(spec), -kMostMetres, kMostMetres); }
// The trigonometric functions lose accuracy with large angles.
inline ParameterSpec Angles(ParameterSpec spec) { return Within(std::move(spec), -kMostDegrees, kMostDegrees); }
inline ParameterSpec Size(ParameterSpec spec) { return Within(std::move(spec), kLeastSize, kMostMetres); }

// It keeps a value that is made from the table of entity kinds. The value is made again after a library has added rows;
// earlier references stay valid.
template <class Made>
class PerTable
{
public:
  template <class Make>
  const Made& Get(Make make)
  {
    const std::lock_guard lock(mutex_);
    const std::size_t rows = EntityKindCount();
    const auto found = made_.find(rows);
    return found != made_.end() ? found->second : made_.emplace(rows, make()).first->second;
  }

private:
  std::mutex mutex_;  // guards made_
  std::map<std::size_t, Made> made_;
};

// Describes <arena>: the space, its entities, and the entities of <distribute> and <reserve>.
ElementSpec Arena();

}  // namespace swarmanoid
