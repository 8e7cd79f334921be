#include "common/bus/topics/cdr.h"

#include <fmt/format.h>

namespace swarmanoid
{

void RefuseField(const char* field, const std::string& why) { throw BadMessage(fmt::format("{}: {}", field, why)); }

void RefuseName(const char* field, const std::string& name)
{
  throw BadMessage(fmt::format("{} '{}' must be one line of UTF-8 text of at most {} bytes without control characters",
                               field, ShowableLine(name, 60), kLongestName));
}

void RefuseLength(const char* field, std::size_t count, std::size_t bytes, std::size_t left)
{
  throw BadMessage(fmt::format("{}: it claims {} bytes; there may be {}", field, count * bytes, left));
}

}  // namespace swarmanoid
