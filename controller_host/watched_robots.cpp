#include "controller_host/watched_robots.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 33ms;     // between two messages, unless every tick is asked for
constexpr auto kRequestTime = 3s;  // after which a request that is not repeated is void

}  // namespace

bool WatchedRobots::Requested(const ViewRequestMessage& request, Clock::time_point now)
{
  const std::lock_guard lock(mutex_);
  Request& client_request = requests_[request.client];
  const bool same = client_request.robots == request.robots && client_request.every_tick == request.every_tick;
  client_request = {request.robots, request.every_tick, now};
  if (same) return false;
  Collect(now);
  return !robots_.empty();
}

void WatchedRobots::Collect(Clock::time_point now)
{
  collected_ = now;
  every_tick_ = false;
  robots_.clear();
  std::erase_if(requests_,
                [&](const auto& client_request) { return now - client_request.second.heard >= kRequestTime; });
  for (const auto& [client, client_request] : requests_)
  {
    every_tick_ |= client_request.every_tick && !client_request.robots.empty();
    for (const std::uint32_t robot : client_request.robots)
      if (std::ranges::binary_search(of_host_, robot)) robots_.push_back(robot);
  }
  std::ranges::sort(robots_);
  robots_.erase(std::unique(robots_.begin(), robots_.end()), robots_.end());
  watched_ = !robots_.empty();
}

std::vector<std::uint32_t> WatchedRobots::TakeDue(Clock::time_point now, bool at_once)
{
  const std::lock_guard lock(mutex_);
  if (now - collected_ >= kRequestTime) Collect(now);
  if (!at_once && !every_tick_ && now - sent_ < kPeriod) return {};
  if (!robots_.empty()) sent_ = now;
  return robots_;
}

}  // namespace swarmanoid
