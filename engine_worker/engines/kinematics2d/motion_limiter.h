// The part of its wanted motion that each body may do in a step, so that outlines that are apart stay apart.
//
// A leader wants to go a way and to turn by an angle, straight from where the step began. It does a part of each, 0 to
// 1: these are the motions. Between two parts of outlines that are near lies a plane. Each motion brings them nearer
// along its normal by at most a rate times its part; the rates of those that part them are negative. If for all planes
//     sum of rate * part  <=  gap,
// no two outlines meet: along the normal, they are as far apart as that leaves.
//
// The parts are raised from 0. In each round a motion gets as much as its planes allow if motions that make room do no
// more than they did after the last round. No motion ever does less later, so all planes hold after any round. More
// rounds let bodies go further that follow each other closely. Source: docs/engines.md, "Crowds: how".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/math/zeroed_vector.h"

namespace swarmanoid::kinematics2d
{

// A leader has two motions with these numbers.
constexpr std::uint32_t WayMotion(std::uint32_t leader) { return 2 * leader; }
constexpr std::uint32_t TurnMotion(std::uint32_t leader) { return 2 * leader + 1; }
constexpr std::uint32_t LeaderOfMotion(std::uint32_t motion) { return motion / 2; }

// How much nearer (m) a motion brings the two sides of a plane if all of it is done.
struct Approach
{
  std::uint32_t motion;
  double rate;
};

// The limits that planes set, found by one thread.
class LimitList
{
public:
  struct Bound
  {
    std::uint32_t motion;
    double most;
  };
  // part <= base + sum of slope * part of the motions that make room.
  struct Chase
  {
    std::uint32_t motion;
    std::uint32_t ahead[2];
    double base;
    double slope[2];
  };

  void Clear();
  // A plane between parts that are `gap` (m, 0 or more) apart. Two leaders have up to four motions. Returns whether it
  // can limit them.
  bool Add(double gap, const std::array<Approach, 4>& approaches);
  void Add(const Bound& bound) { bounds_.push_back(bound); }
  void Add(const Chase& chase) { chases_.push_back(chase); }
  const std::vector<Bound>& Bounds() const { return bounds_; }
  const std::vector<Chase>& Chases() const { return chases_; }

private:
  std::vector<Bound> bounds_;
  std::vector<Chase> chases_;
};

class MotionLimiter
{
public:
  void Configure(std::size_t leaders);
  // Changes the number of leaders: after Clear, or to more leaders before their limits are added.
  void MakeRoom(std::size_t leaders);
  // Ends all limits.
  void Clear();
  void Add(const LimitList& limits);
  // Finds the parts under all limits that were added. Depends on their set, not on their order.
  void Raise();

  double PartOf(std::uint32_t motion) const { return part_[place_[motion]]; }
  // Returns the leaders with a limited motion, after Raise; each once.
  const std::vector<std::uint32_t>& Limited() const { return limited_; }

private:
  // Gives the motion a place of its own if it has none.
  std::uint32_t Touch(std::uint32_t motion);

  std::vector<LimitList::Chase> chases_;
  std::vector<LimitList::Chase> by_place_;  // the same with places for motions
  // One entry for each motion with limits. The entry in front is that of all others, which is 1.
  std::vector<double> most_, part_, next_;
  std::vector<std::uint32_t> touched_;  // the motion of each of these, but the first
  ZeroedVector<std::uint32_t> place_;   // of each motion in these; 0: nothing limits it
  std::vector<std::uint32_t> limited_;
};

}  // namespace swarmanoid::kinematics2d
