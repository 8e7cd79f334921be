#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

void OnDemandSensor::InitDemand(std::size_t robots)
{
  robots_asked_.assign(robots, kAsked | kAskedBefore);
  due_.assign(robots, 0);
  EndSteps();
}

void OnDemandSensor::MakeAhead()
{
  RefreshShared(nullptr);
  if (BeginSteps()) MakeDue();
}

bool OnDemandSensor::BeginSteps()
{
  in_steps_ = true;
  there_ = kThere;
  asked_ = kAsked | kThere;
  rest_is_there_.store(false, std::memory_order_relaxed);
  std::uint8_t any = 0, all = 1;
  const std::size_t count = due_.size();
  std::uint8_t* const robots = robots_asked_.data();
  std::uint8_t* const dues = due_.data();
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::uint8_t robot = robots[k];
    const auto due = static_cast<std::uint8_t>(robot & (robot >> 2) & kAsked);
    any |= due;
    all &= due;
    dues[k] = due;
    robots[k] = static_cast<std::uint8_t>((robot & kAsked) << 2 | due << 1);
  }
  all_are_due_ = all != 0;
  return any != 0;
}

void OnDemandSensor::EndSteps()
{
  in_steps_ = false;
  there_ = kAsked | kBetween;
  asked_ = kBetween;
}

void OnDemandSensor::Make(std::size_t k)
{
  const std::atomic_ref robot(robots_asked_[k]);
  const auto note = [&]
  {
    const std::uint8_t bits = robot.load(std::memory_order_relaxed);
    robot.store(static_cast<std::uint8_t>(bits | asked_), std::memory_order_release);
  };
  if (in_steps_ && rest_is_there_.load(std::memory_order_acquire)) return note();
  const std::lock_guard lock(making_);
  // Another robot may have asked meanwhile, or another thread of this one's controller.
  const bool is_there = (in_steps_ && rest_is_there_.load(std::memory_order_relaxed)) ||
                        (robot.load(std::memory_order_relaxed) & there_) != 0;
  if (!is_there)
  {
    if (!in_steps_) RefreshShared(nullptr);
    if (!MakeAlone(k)) MakeRest();
  }
  note();
}

// Readings that were requested between steps are kept.
void OnDemandSensor::MakeRest()
{
  all_are_due_ = false;
  for (std::size_t other = 0; other < due_.size(); ++other)
    due_[other] = in_steps_ ? due_[other] ^ 1U : (robots_asked_[other] & (kAsked | kBetween)) == 0;
  MakeDue();
  if (in_steps_) return rest_is_there_.store(true, std::memory_order_release);
  for (std::size_t other = 0; other < due_.size(); ++other)
    if (due_[other] != 0) robots_asked_[other] |= kBetween;
}

}  // namespace swarmanoid
