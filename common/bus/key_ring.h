// The keys by which a process knows the messages of its run: the one that it was given, or those of the runs of its
// user in its domain. Used by the bus; from any thread.
#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "common/bus/seal.h"

namespace swarmanoid
{

class KeyRing
{
public:
  // `given`: the only key that counts; otherwise they are looked for among the runs of this machine.
  KeyRing(int domain, std::optional<RunKey> given) : domain_(domain), given_(given) {}

  // By which messages to the run of that experiment are sealed.
  std::optional<RunKey> Of(const std::string& experiment);
  // The number of a sealed message that came in `partition`, an experiment or "*"; nullopt if no key opens it.
  std::optional<std::uint64_t> Open(const std::string& partition, std::span<const char> payload, std::string_view topic,
                                    const WriterId& writer);

private:
  using Clock = std::chrono::steady_clock;

  const int domain_;
  const std::optional<RunKey> given_;
  std::mutex mutex_;                     // of what follows
  std::map<std::string, RunKey> known_;  // by experiment
  Clock::time_point looked_;             // among the runs, while a key was known
};

}  // namespace swarmanoid
