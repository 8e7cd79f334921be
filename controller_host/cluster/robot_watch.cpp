#include "controller_host/cluster/robot_watch.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 33ms;  // between two messages, unless every tick is wished for
constexpr auto kWishTime = 3s;  // after which a wish that is not repeated is void

}  // namespace

RobotWatch::RobotWatch(WorkerSession& session, const ControllerHost& role, std::uint32_t host, std::mutex& step)
    : session_(session), role_(role), step_(step), statuses_(session.GetBus(), session.World().experiment)
{
  message_.run = session.World().run;
  message_.source = host;
  wishes_in_ = std::make_unique<Subscription<WishesMessage>>(session.GetBus(), session.World().experiment,
                                                             [this](const WishesMessage& w) { Wished(w); });
}

RobotWatch::~RobotWatch() { wishes_in_.reset(); }

void RobotWatch::Wished(const WishesMessage& wishes)
{
  if (wishes.run != session_.World().run) return;
  {
    const std::lock_guard lock(mutex_);
    Wish& wish = wishes_[wishes.client];
    const bool same = wish.robots == wishes.robots && wish.every_tick == wishes.every_tick;
    wish = {wishes.robots, wishes.every_tick, Clock::now()};
    if (same) return;
    Gather(wish.heard);
    if (robots_.empty()) return;
  }
  // A paused run makes no step: what there is is told at once.
  const std::lock_guard step(step_);
  const std::lock_guard lock(mutex_);
  Send(Clock::now());
}

void RobotWatch::Gather(Clock::time_point now)
{
  gathered_ = now;
  every_tick_ = false;
  robots_.clear();
  std::erase_if(wishes_, [&](const auto& wish) { return now - wish.second.heard >= kWishTime; });
  for (const auto& [client, wish] : wishes_)
  {
    every_tick_ |= wish.every_tick && !wish.robots.empty();
    for (const std::uint32_t robot : wish.robots)
      if (std::ranges::binary_search(role_.Layout().robots, robot)) robots_.push_back(robot);
  }
  std::ranges::sort(robots_);
  robots_.erase(std::unique(robots_.begin(), robots_.end()), robots_.end());
  watched_ = !robots_.empty();
}

void RobotWatch::Tell()
{
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (now - gathered_ >= kWishTime) Gather(now);
  if (every_tick_ || now - sent_ >= kPeriod) Send(now);
}

void RobotWatch::Send(Clock::time_point now)
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
    // Those who watch miss one; the run goes on.
  }
}

}  // namespace swarmanoid
