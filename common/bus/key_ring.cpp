#include "common/bus/key_ring.h"

#include "common/bus/run_directory.h"

namespace swarmanoid
{
namespace
{

constexpr auto kBetweenLooks = std::chrono::milliseconds(20);

}  // namespace

std::optional<RunKey> KeyRing::Of(const std::string& experiment)
{
  if (given_) return given_;
  const std::lock_guard lock(mutex_);
  if (const auto found = known_.find(experiment); found != known_.end()) return found->second;
  for (const LocalRun& run : FindLocalRuns())
    if (run.domain == domain_ && run.experiment == experiment && run.key) return known_[experiment] = *run.key;
  return std::nullopt;
}

std::optional<std::uint64_t> KeyRing::Open(const std::string& partition, std::span<const char> payload,
                                           std::string_view topic, const WriterId& writer)
{
  if (given_) return NumberUnderSeal(payload, *given_, topic, writer);
  const std::lock_guard lock(mutex_);
  const auto found = partition == "*" ? known_.begin() : known_.find(partition);
  if (found != known_.end())
  {
    if (const auto number = NumberUnderSeal(payload, found->second, topic, writer)) return number;
    // Whoever sends what no key opens does not make us look all the time. Another run may have begun.
    const Clock::time_point now = Clock::now();
    if (now - looked_ < kBetweenLooks) return std::nullopt;
    looked_ = now;
  }
  for (const LocalRun& run : FindLocalRuns())
  {
    if (run.domain != domain_ || !run.key || (partition != "*" && partition != run.experiment)) continue;
    const auto number = NumberUnderSeal(payload, *run.key, topic, writer);
    if (!number) continue;
    known_[run.experiment] = *run.key;
    return number;
  }
  return std::nullopt;
}

}  // namespace swarmanoid
