// WatchedRobots: the robots of a host whose inside visualisers ask for, and when it is due. The controller_host program
// and runs in one process use it. Requests may come in any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "idl/view_request_message.h"

namespace swarmanoid
{

class WatchedRobots
{
public:
  using Clock = std::chrono::steady_clock;

  // `robots`: those of the host, ascending. They must outlive the object.
  explicit WatchedRobots(std::span<const std::uint32_t> robots) : of_host_(robots) {}

  // Takes the request of a visualiser. Returns true if it asks for other robots than before and some of the host are
  // watched: they are due at once, since a paused run makes no step.
  bool Requested(const ViewRequestMessage& request, Clock::time_point now);
  // Returns whether any robot is watched. It costs one test of a flag.
  bool AreAny() const { return watched_; }
  // Returns the watched robots if they are due, ascending. Empty: nothing is due. `at_once`: they are due in any case.
  std::vector<std::uint32_t> TakeDue(Clock::time_point now, bool at_once);

private:
  struct Request
  {
    std::vector<std::uint32_t> robots;
    bool every_tick = false;
    Clock::time_point heard;
  };

  // Collects the robots that all visualisers together ask for.
  void Collect(Clock::time_point now);

  const std::span<const std::uint32_t> of_host_;
  std::atomic<bool> watched_ = false;

  std::mutex mutex_;  // guards the members below
  std::map<std::string, Request> requests_;
  std::vector<std::uint32_t> robots_;
  bool every_tick_ = false;
  Clock::time_point collected_;
  Clock::time_point sent_;
};

}  // namespace swarmanoid
