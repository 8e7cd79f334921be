#include "engine_worker/engines/kinematics2d/motion_limiter.h"

#include <algorithm>

namespace swarmanoid::kinematics2d
{
namespace
{

// A row of robots that touch one another and drive on needs as many rounds as its allowed overlap goes into its way.
constexpr int kMostRounds = 64;
// Parts that rise by less change nothing that can be seen.
constexpr double kLeastRise = 1e-3;
// Metres. What approaches by less is rounding: two that slide along each other.
constexpr double kNothing = 1e-14;

}  // namespace

void LimitList::Clear()
{
  bounds_.clear();
  chases_.clear();
}

bool LimitList::Add(double gap, const std::array<Approach, 4>& approaches)
{
  double nearer = 0;
  for (const Approach& approach : approaches) nearer += std::max(0.0, approach.rate);
  if (nearer <= gap || nearer <= kNothing) return false;
  Chase chase{0, {0, 0}, gap / nearer, {0, 0}};
  int makes_room = 0;
  for (const Approach& approach : approaches)
  {
    // A third one that makes room is left out, which allows less than there is.
    if (!(approach.rate < 0) || makes_room == 2) continue;
    chase.ahead[makes_room] = approach.motion;
    chase.slope[makes_room++] = -approach.rate / nearer;
  }
  for (const Approach& approach : approaches)
  {
    if (!(approach.rate > 0)) continue;
    chase.motion = approach.motion;
    if (makes_room == 0)
      bounds_.push_back({approach.motion, chase.base});
    else
      chases_.push_back(chase);
  }
  return true;
}

void MotionLimiter::Configure(std::size_t leaders)
{
  most_.assign(2 * leaders, 1);
  part_ = next_ = most_;
  is_touched_.assign(2 * leaders, 0);
  touched_.reserve(2 * leaders);
  limited_.reserve(leaders);
}

void MotionLimiter::MakeRoom(std::size_t leaders)
{
  const bool is_much_too_large = part_.size() > 8 * leaders;
  if (2 * leaders <= part_.size() && !is_much_too_large) return;
  for (std::vector<double>* of_motions : {&most_, &part_, &next_})
  {
    of_motions->resize(2 * leaders, 1);
    if (is_much_too_large) of_motions->shrink_to_fit();
  }
  is_touched_.resize(2 * leaders, 0);
}

void MotionLimiter::Clear()
{
  for (const std::uint32_t motion : touched_)
  {
    most_[motion] = part_[motion] = next_[motion] = 1;
    is_touched_[motion] = 0;
  }
  touched_.clear();
  limited_.clear();
  chases_.clear();
}

void MotionLimiter::Touch(std::uint32_t motion)
{
  if (is_touched_[motion] != 0) return;
  is_touched_[motion] = 1;
  touched_.push_back(motion);
}

void MotionLimiter::Add(const LimitList& limits)
{
  for (const LimitList::Bound& bound : limits.Bounds())
  {
    Touch(bound.motion);
    most_[bound.motion] = std::min(most_[bound.motion], bound.most);
  }
  for (const LimitList::Chase& chase : limits.Chases()) Touch(chase.motion);
  chases_.insert(chases_.end(), limits.Chases().begin(), limits.Chases().end());
}

void MotionLimiter::Raise()
{
  for (const std::uint32_t motion : touched_) part_[motion] = next_[motion] = most_[motion];
  for (const LimitList::Chase& chase : chases_) part_[chase.motion] = 0;
  bool rises = !chases_.empty();
  for (int round = 0; rises && round < kMostRounds; ++round)
  {
    for (const LimitList::Chase& chase : chases_) next_[chase.motion] = most_[chase.motion];
    for (const LimitList::Chase& chase : chases_)
    {
      const double most = chase.base + chase.slope[0] * part_[chase.ahead[0]] + chase.slope[1] * part_[chase.ahead[1]];
      next_[chase.motion] = std::min(next_[chase.motion], most);
    }
    rises = false;
    for (const LimitList::Chase& chase : chases_) rises |= next_[chase.motion] > part_[chase.motion] + kLeastRise;
    std::swap(part_, next_);
  }

  for (const std::uint32_t motion : touched_)
  {
    const std::uint32_t leader = LeaderOfMotion(motion);
    const bool counted_before = motion % 2 == 1 && part_[WayMotion(leader)] < 1;
    if (part_[motion] < 1 && !counted_before) limited_.push_back(leader);
  }
}

}  // namespace swarmanoid::kinematics2d
