#include "engine_worker/engines/kinematics2d/motion_limiter.h"

#include <algorithm>

namespace swarmanoid::kinematics2d
{
namespace
{

// A row of robots that touch each other and drive on needs about as many rounds as its way divided by its allowed
// overlap.
constexpr int kMostRounds = 64;
// Parts that rise by less change nothing that can be seen.
constexpr double kLeastRise = 1e-3;
// Metres. A smaller approach is rounding: two bodies slide along each other.
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
  place_.resize(2 * leaders);
  limited_.reserve(leaders);
  most_ = part_ = next_ = {1};
}

void MotionLimiter::MakeRoom(std::size_t leaders)
{
  const bool is_much_too_large = place_.size() > 8 * leaders;
  if (2 * leaders <= place_.size() && !is_much_too_large) return;
  place_.resize(2 * leaders);
  if (is_much_too_large) place_.shrink_to_fit();
}

void MotionLimiter::Clear()
{
  for (const std::uint32_t motion : touched_) place_[motion] = 0;
  touched_.clear();
  limited_.clear();
  chases_.clear();
  most_.resize(1);
  part_.resize(1);
  next_.resize(1);
}

std::uint32_t MotionLimiter::Touch(std::uint32_t motion)
{
  if (place_[motion] == 0)
  {
    touched_.push_back(motion);
    place_[motion] = static_cast<std::uint32_t>(touched_.size());
    most_.push_back(1);
  }
  return place_[motion];
}

void MotionLimiter::Add(const LimitList& limits)
{
  for (const LimitList::Bound& bound : limits.Bounds())
  {
    const std::uint32_t place = Touch(bound.motion);
    most_[place] = std::min(most_[place], bound.most);
  }
  for (const LimitList::Chase& chase : limits.Chases()) Touch(chase.motion);
  chases_.insert(chases_.end(), limits.Chases().begin(), limits.Chases().end());
}

void MotionLimiter::Raise()
{
  part_ = next_ = most_;
  by_place_ = chases_;
  for (LimitList::Chase& chase : by_place_)
  {
    chase.motion = place_[chase.motion];
    for (std::uint32_t& ahead : chase.ahead) ahead = place_[ahead];
  }
  for (const LimitList::Chase& chase : by_place_) part_[chase.motion] = 0;
  bool rises = !by_place_.empty();
  for (int round = 0; rises && round < kMostRounds; ++round)
  {
    for (const LimitList::Chase& chase : by_place_) next_[chase.motion] = most_[chase.motion];
    for (const LimitList::Chase& chase : by_place_)
    {
      const double most = chase.base + chase.slope[0] * part_[chase.ahead[0]] + chase.slope[1] * part_[chase.ahead[1]];
      next_[chase.motion] = std::min(next_[chase.motion], most);
    }
    rises = false;
    for (const LimitList::Chase& chase : by_place_) rises |= next_[chase.motion] > part_[chase.motion] + kLeastRise;
    std::swap(part_, next_);
  }

  for (const std::uint32_t motion : touched_)
  {
    const std::uint32_t leader = LeaderOfMotion(motion);
    const bool counted_before = motion % 2 == 1 && PartOf(WayMotion(leader)) < 1;
    if (PartOf(motion) < 1 && !counted_before) limited_.push_back(leader);
  }
}

}  // namespace swarmanoid::kinematics2d
