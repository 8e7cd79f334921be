// Publish: numbers of experiment functions for the table of a study (docs/studies.md). <published name="preys"> takes
// the last number of this name. The numbers are no part of the state. A PublishedNumbers in the process of the space
// server collects them. Without one, publishing costs a look at an empty list. Only one thread may use it.
//
//   Publish(space.GetSpace(), "preys", delivered_);
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

// Collects the numbers that are published about a space during its lifetime. The space outlives it.
class PublishedNumbers
{
public:
  explicit PublishedNumbers(const CSwarmanoidSpace& space) : space_(&space) { All().push_back(this); }
  ~PublishedNumbers() { std::erase(All(), this); }
  PublishedNumbers(const PublishedNumbers&) = delete;
  PublishedNumbers& operator=(const PublishedNumbers&) = delete;

  // Returns the last one of each name.
  const std::map<std::string, double, std::less<>>& Values() const { return values_; }

private:
  friend void Publish(const CSwarmanoidSpace& space, std::string_view name, double value);

  static std::vector<PublishedNumbers*>& All()
  {
    static std::vector<PublishedNumbers*> all;
    return all;
  }

  const CSwarmanoidSpace* space_;
  std::map<std::string, double, std::less<>> values_;
};

// Publishes a number under a name. Throws std::invalid_argument if it is not finite, even if no object collects it.
inline void Publish(const CSwarmanoidSpace& space, std::string_view name, double value)
{
  if (!std::isfinite(value))
    throw std::invalid_argument("'" + std::string(name) + "' is published as no finite number");
  for (PublishedNumbers* numbers : PublishedNumbers::All())
  {
    if (numbers->space_ != &space) continue;
    if (const auto known = numbers->values_.find(name); known != numbers->values_.end())
      known->second = value;
    else
      numbers->values_.emplace(name, value);
  }
}

}  // namespace swarmanoid
