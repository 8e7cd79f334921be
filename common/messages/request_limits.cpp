#include "common/messages/request_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/configuration/shown_text.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kShownBytes = 60;

std::string NameError(const char* what, const std::string& name)
{
  const std::string shown = ShowableLine(name, kShownBytes);
  if (name.size() > kLongestName)
    return fmt::format("the {} '{}…' has {} bytes; it must have at most {}", what, shown, name.size(), kLongestName);
  if (!IsShowableLine(name))
    return fmt::format("the {} '{}' must be one line of UTF-8 text without control characters", what, shown);
  return {};
}

}  // namespace

std::string RequestLimitError(const ControlRequestMessage& request)
{
  if (std::string error = NameError("request", request.verb); !error.empty()) return error;
  const bool is_key = request.verb == "press" || request.verb == "release";
  if (const std::string error = NameError(is_key ? "key" : "name", request.entity); !error.empty())
    return request.verb + ": " + error;
  if (request.numbers.size() > kMostRequestNumbers)
    return fmt::format("{}: there are {} numbers; at most {} can be given", request.verb, request.numbers.size(),
                       kMostRequestNumbers);
  if (!std::ranges::all_of(request.numbers, [](double number) { return std::isfinite(number); }))
    return fmt::format("{}: a number is not finite", request.verb);
  return {};
}

}  // namespace swarmanoid
