// Chooses whether one thread or several do a piece of work that recurs at each tick: the way that took less time
// recently. Work of a few microseconds stays in one thread. One thread continues if other programs need the cores, also
// if their need starts between two trials. Work that grows is tried again. The results must be the same either way.
// Only one thread calls this class.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "common/threads/worker_pool.h"

namespace swarmanoid
{

class ThreadChoice
{
public:
  using Duration = std::chrono::nanoseconds;
  static constexpr Duration kWorthWaking{20'000};  // shorter work is never shared
  static constexpr unsigned kTrials = 4;           // for each way; the shortest counts (the first wakes the threads)
  static constexpr unsigned kLeastGain = 10;       // sharing must save more than 1 / kLeastGain of the time
  // Pieces until both ways are tried again. The period is short at first, since the first pieces of a run differ from
  // later ones, and doubles each time.
  static constexpr unsigned kFirstPeriod = 32;
  static constexpr unsigned kPeriod = 512;
  static constexpr unsigned kMostPeriod = 16 * kPeriod;  // while sharing is slower each time
  // Sharing is late by the time that it takes longer than one thread did; each piece counts as at most kMostLate
  // pieces. When kPatience pieces are lost, one thread is tried again. One thread now takes longer if the work has
  // grown, and as long as before if others have taken the cores.
  static constexpr int kMostLate = 4;
  static constexpr int kPatience = 8;

  // Returns whether several threads do the next piece.
  bool Shares() const { return shares_; }

  // Returns whether the time of the next piece matters. Reading a clock twice costs 2 % of a tick of a few
  // microseconds.
  bool Measures() const { return shares_ || pieces_ < 2 * kTrials; }

  // States how long the piece took. Any value will do if it does not matter.
  void Took(Duration time)
  {
    ++pieces_;
    if (pieces_ <= kTrials)
      alone_ = std::min(alone_, time);
    else if (pieces_ <= 2 * kTrials)
      shared_ = std::min(shared_, time);
    else if (shares_)
    {
      late_ = std::max(late_ + std::min(time - alone_, kMostLate * alone_), Duration::zero());
      if (late_ > kPatience * alone_) return Begin(period_, alone_);
    }
    if (pieces_ == kTrials) shares_ = alone_ >= kWorthWaking && alone_ >= alone_before_ + alone_before_ / kLeastGain;
    if (pieces_ == 2 * kTrials) shares_ = shares_ && shared_ < alone_ - alone_ / kLeastGain;
    if (pieces_ < period_) return;
    const bool lost = alone_ >= kWorthWaking && !shares_;
    Begin(std::min(2 * period_, lost ? kMostPeriod : kPeriod), Duration::zero());
  }

private:
  void Begin(unsigned period, Duration alone_before)
  {
    *this = ThreadChoice();
    period_ = period;
    alone_before_ = alone_before;
  }

  bool shares_ = false;
  unsigned period_ = kFirstPeriod;
  unsigned pieces_ = 0;                       // in the current period
  Duration alone_before_ = Duration::zero();  // set when several threads became late; 0 if they are not
  Duration alone_ = Duration::max();
  Duration shared_ = Duration::max();
  Duration late_ = Duration::zero();
};

// Runs the ticks of a process whose roles have a pool, with or without the pool's threads. A tick shares all of its
// work or nothing. Threads that have just worked take up the next part at once, while sleeping threads must be woken.
class ThreadedTicks
{
public:
  // `pool`: nullptr for one thread. Code in `tick` asks the pool whether it shares.
  template <class Tick>
  void Do(WorkerPool* pool, const Tick& tick)
  {
    if (pool == nullptr || pool->Threads() == 1) return tick();
    pool->Share(choice_.Shares());
    if (choice_.Shares()) ++shared_;
    if (!choice_.Measures())
    {
      tick();
      return choice_.Took({});
    }
    const auto start = std::chrono::steady_clock::now();
    tick();
    choice_.Took(std::chrono::steady_clock::now() - start);
  }
  // Returns the number of ticks that several threads did.
  std::uint64_t Shared() const { return shared_; }

private:
  ThreadChoice choice_;
  std::uint64_t shared_ = 0;
};

}  // namespace swarmanoid
