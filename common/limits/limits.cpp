#include "common/limits/limits.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "common/memory/memory_limit.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kMemory = "SWARMANOID_MEMORY_LIMIT";  // bytes
constexpr const char* kStep = "SWARMANOID_STEP_TIMEOUT";    // seconds

template <class Number>
Number NumberIn(const char* variable)
{
  const char* text = std::getenv(variable);
  if (text == nullptr) return 0;
  const std::string_view digits = text;
  Number number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? number : 0;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> EnvironmentOf(const Limits& limits)
{
  std::vector<std::pair<std::string, std::string>> environment;
  if (limits.memory_bytes != 0) environment.emplace_back(kMemory, std::to_string(limits.memory_bytes));
  if (limits.step_s > 0) environment.emplace_back(kStep, fmt::format("{}", limits.step_s));
  return environment;
}

Limits LimitsOfEnvironment() { return {NumberIn<std::uint64_t>(kMemory), NumberIn<double>(kStep)}; }

void ApplyLimits(const Limits& limits, std::function<void(const std::string&, double)> stalled)
{
  static std::unique_ptr<StepTimeout> watch;
  if (watch != nullptr) return;
  LimitMemory(limits.memory_bytes);
  StepTimeout::Settings settings;
  settings.limit = std::chrono::milliseconds(static_cast<std::int64_t>(limits.step_s * 1000));
  settings.stalled = std::move(stalled);
  // Without a limit or a callback, no thread needs to watch.
  if (settings.limit.count() > 0 || settings.stalled) watch = std::make_unique<StepTimeout>(std::move(settings));
}

}  // namespace swarmanoid
