#include "common/bus/security/key_ring.h"

#include "common/run/access/run_directory.h"

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
  if (const auto found = known_.find(experiment); found != known_.end()) return own_ = found->second;
  for (const LocalRun& run : FindLocalRuns())
    if (run.domain == domain_ && run.experiment == experiment && run.key) return own_ = known_[experiment] = *run.key;
  return std::nullopt;
}

std::optional<RunKey> KeyRing::Own() const
{
  if (given_) return given_;
  const std::lock_guard lock(mutex_);
  return own_;
}

std::vector<RunKey> KeyRing::Known() const
{
  if (given_) return {*given_};
  const std::lock_guard lock(mutex_);
  std::vector<RunKey> keys;
  for (const auto& [experiment, key] : known_) keys.push_back(key);
  return keys;
}

bool KeyRing::Try(const std::string& partition, const std::function<bool(const RunKey&)>& opens)
{
  if (given_) return opens(*given_);
  const std::lock_guard lock(mutex_);
  const auto found = partition == "*" ? known_.begin() : known_.find(partition);
  if (found != known_.end())
  {
    if (opens(found->second)) return true;
    // Another run may have begun, so the runs are searched again. The interval limits the cost of messages that no key
    // opens.
    const Clock::time_point now = Clock::now();
    if (now - looked_ < kBetweenLooks) return false;
    looked_ = now;
  }
  for (const LocalRun& run : FindLocalRuns())
  {
    if (run.domain != domain_ || !run.key || (partition != "*" && partition != run.experiment)) continue;
    if (!opens(*run.key)) continue;
    known_[run.experiment] = *run.key;
    // Other processes can recognise this process once it has received its first message of a run.
    if (!own_) own_ = run.key;
    return true;
  }
  return false;
}

}  // namespace swarmanoid
