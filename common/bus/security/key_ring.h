// The keys that identify messages of a process's run: the given key, or those of its user's runs in its domain. The bus
// uses it; any thread may call it.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/run/access/run_key.h"

namespace swarmanoid
{

class KeyRing
{
public:
  // `given`: the only valid key. Without it, keys are searched for among the runs of this machine.
  KeyRing(int domain, std::optional<RunKey> given) : domain_(domain), given_(given) {}

  // Returns the key that seals messages to the run of that experiment.
  std::optional<RunKey> Of(const std::string& experiment);
  // Returns the key that signs datagrams. It is the key that sealed the last message or, before that, the first key
  // that opened one. It is empty before the first message.
  std::optional<RunKey> Own() const;
  // Returns all keys that have opened or sealed a message.
  std::vector<RunKey> Known() const;
  // Returns whether one of the keys `opens` a message that came in `partition`, an experiment or "*".
  bool Try(const std::string& partition, const std::function<bool(const RunKey&)>& opens);

private:
  using Clock = std::chrono::steady_clock;

  const int domain_;
  const std::optional<RunKey> given_;
  mutable std::mutex mutex_;             // protects the following members
  std::optional<RunKey> own_;            // if none was given
  std::map<std::string, RunKey> known_;  // by experiment
  Clock::time_point looked_;             // the last search while a key was known
};

}  // namespace swarmanoid
