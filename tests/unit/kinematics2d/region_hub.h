// Exchange of messages between the regions of a kinematic world in one process, for tests and benchmarks: each region
// in a thread of its own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "engine_worker/engines/kinematics2d/region_exchange.h"

namespace swarmanoid::kinematics2d
{

// Where the regions of one process, each in a thread of its own, leave their messages for one another.
class Hub
{
public:
  explicit Hub(unsigned regions) : left_(regions), taken_(regions) {}

  unsigned RegionCount() const { return static_cast<unsigned>(left_.size()); }
  // Of all calls of Swap so far, which are the same for each region; all messages together.
  std::uint64_t Rounds() const { return rounds_; }
  std::uint64_t Bytes() const { return bytes_; }
  // One of them takes part no more: the others need not wait for it.
  void Break()
  {
    const std::lock_guard lock(mutex_);
    is_broken_ = true;
    changed_.notify_all();
  }
  void Swap(unsigned region, std::span<const ByteWriter> out, std::span<std::vector<char>> in)
  {
    std::unique_lock lock(mutex_);
    left_[region].clear();
    for (const ByteWriter& message : out)
    {
      left_[region].push_back(message.Bytes());
      bytes_ += message.Bytes().size();
    }
    const std::uint64_t round = rounds_;
    if (++here_ == RegionCount())
    {
      here_ = 0;
      ++rounds_;
      left_.swap(taken_);
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return rounds_ != round || is_broken_; });
    if (rounds_ == round) throw std::runtime_error("another region has ended");
    for (unsigned k = 0; k < RegionCount(); ++k) in[k] = taken_[k][region];
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<std::vector<char>>> left_, taken_;  // by sender and receiver
  unsigned here_ = 0;
  std::uint64_t rounds_ = 0;
  std::uint64_t bytes_ = 0;
  bool is_broken_ = false;
};

class HubExchange : public RegionExchange
{
public:
  HubExchange(Hub& hub, unsigned region) : hub_(hub), region_(region) {}
  unsigned RegionCount() const override { return hub_.RegionCount(); }
  void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) override { hub_.Swap(region_, out, in); }

private:
  Hub& hub_;
  unsigned region_;
};

}  // namespace swarmanoid::kinematics2d
