// Finds ids that may not stand beside one another in an experiment: equal ones, and ones whose 64-bit names for random
// streams are equal, who would draw the same numbers. Used by the readers of sections with ids.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

namespace swarmanoid
{

class UniqueIds
{
public:
  // `what`: "entities".
  explicit UniqueIds(std::string what, std::size_t expected = 0) : what_(std::move(what)) { first_.reserve(expected); }

  // What is wrong with a further id, which stands in this line; empty if nothing is. Empty ids are passed over.
  std::string Add(const std::string& id, int line);

private:
  struct First
  {
    std::string id;
    int line;
  };
  std::string what_;
  std::unordered_map<std::uint64_t, First> first_;  // by StreamName
};

}  // namespace swarmanoid
