#include "controller_host/cluster/robot_inspection.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 33ms;     // between two messages, unless every tick is asked for
constexpr auto kRequestTime = 3s;  // after which a request that is not repeated is void

}  // namespace

RobotInspection::RobotInspection(WorkerSession& session, const ControllerHost& role, std::uint32_t host,
                                 std::mutex& step)
    : session_(session), role_(role), step_(step), statuses_(session.GetBus(), session.World().experiment)
{
  message_.run = session.World().run;
  message_.source = host;
  requests_in_ = std::make_unique<Subscription<ViewRequestMessage>>(
      session.GetBus(), session.World().experiment, [this](const ViewRequestMessage& w) { Requested(w); });
}

RobotInspection::~RobotInspection() { requests_in_.reset(); }

void RobotInspection::Requested(const ViewRequestMessage& request)
{
  if (request.run != session_.World().run) return;
  {
    const std::lock_guard lock(mutex_);
    Request& client_request = requests_[request.client];
    const bool same = client_request.robots == request.robots && client_request.every_tick == request.every_tick;
    client_request = {request.robots, request.every_tick, Clock::now()};
    if (same) return;
    Collect(client_request.heard);
    if (robots_.empty()) return;
  }
  // A paused run makes no step, so the present values are sent at once.
  const std::lock_guard step(step_);
  const std::lock_guard lock(mutex_);
  Send(Clock::now());
}

void RobotInspection::Collect(Clock::time_point now)
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
      if (std::ranges::binary_search(role_.Layout().robots, robot)) robots_.push_back(robot);
  }
  std::ranges::sort(robots_);
  robots_.erase(std::unique(robots_.begin(), robots_.end()), robots_.end());
  watched_ = !robots_.empty();
}

void RobotInspection::Publish()
{
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (now - collected_ >= kRequestTime) Collect(now);
  if (every_tick_ || now - sent_ >= kPeriod) Send(now);
}

void RobotInspection::Send(Clock::time_point now)
{
  if (robots_.empty()) return;
  message_.robots.resize(robots_.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) role_.Describe(robots_[i], message_.robots[i]);
  message_.tick = message_.robots.front().tick;
  sent_ = now;
  try
  {
    statuses_.Write(message_);
  }
  catch (const BusError&)
  {
    // An observer misses one message, and the run goes on.
  }
}

}  // namespace swarmanoid
