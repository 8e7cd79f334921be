#include "common/experiment/unique_ids.h"

#include <fmt/format.h>

#include "common/configuration/wording.h"
#include "common/math/random.h"

namespace swarmanoid
{

std::string UniqueIds::Add(const std::string& id, int line)
{
  if (id.empty()) return {};
  const auto [place, is_first] = first_.try_emplace(StreamName(id), First{id, line});
  if (is_first) return {};
  const First& first = place->second;
  if (first.id == id)
    return fmt::format("two {} have the id {}; the first is in line {}", what_, Quoted(id), first.line);
  return fmt::format(
      "the ids {} and {} (line {}) of two {} have the same 64-bit name, by which random numbers are drawn; "
      "rename one of them",
      Quoted(id), Quoted(first.id), first.line, what_);
}

}  // namespace swarmanoid
