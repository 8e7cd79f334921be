// Finds ids that must not occur together in an experiment: equal ids, and ids with equal 64-bit names for random
// streams, which would draw the same numbers. The readers of sections with ids use it.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

namespace swarmanoid
{

class UniqueIds
{
public:
  // `what` names the things with ids in messages: "entities".
  explicit UniqueIds(std::string what, std::size_t expected = 0) : what_(std::move(what)) { first_.reserve(expected); }

  // Adds an id that is in this line. Returns the mistake, or an empty text. Empty ids are ignored.
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
