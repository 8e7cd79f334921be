// The keys by which a process knows the messages of its run: the one that it was given, or those of the runs of its
// user in its domain. Used by the bus; from any thread.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/security/run_key.h"

namespace swarmanoid
{

class KeyRing
{
public:
  // `given`: the only key that counts; otherwise they are looked for among the runs of this machine.
  KeyRing(int domain, std::optional<RunKey> given) : domain_(domain), given_(given) {}

  // By which messages to the run of that experiment are sealed.
  std::optional<RunKey> Of(const std::string& experiment);
  // By which datagrams are signed: the one by which a message was sealed last or, before, the first that came; if none
  // did, none.
  std::optional<RunKey> Own() const;
  // All that messages came by, and that they are sealed by.
  std::vector<RunKey> Known() const;
  // Whether one of the keys `opens` a message that came in `partition`, an experiment or "*".
  bool Try(const std::string& partition, const std::function<bool(const RunKey&)>& opens);

private:
  using Clock = std::chrono::steady_clock;

  const int domain_;
  const std::optional<RunKey> given_;
  mutable std::mutex mutex_;             // of what follows
  std::optional<RunKey> own_;            // if none was given
  std::map<std::string, RunKey> known_;  // by experiment
  Clock::time_point looked_;             // among the runs, while a key was known
};

}  // namespace swarmanoid
