// Whether a piece of work that comes again at each tick is done by one thread or by several: by whichever took less
// time lately. Work of a few microseconds wakes nobody, and where other programs need the cores one thread goes on
// alone, also if they come to need them between two trials; work that grows is tried anew. For work whose results are
// the same either way. One thread at a time.
#pragma once

#include <algorithm>
#include <chrono>

#include "common/threads/worker_pool.h"

namespace swarmanoid
{

class ThreadChoice
{
public:
  using Duration = std::chrono::nanoseconds;
  static constexpr Duration kWorthWaking{20'000};  // work that takes less is never shared
  static constexpr unsigned kTrials = 4;           // of each way; the shortest counts (the first wakes the threads)
  static constexpr unsigned kLeastGain = 10;       // sharing is worth it if it saves more than one such part
  // Pieces until both ways are tried again: few at first, since the first pieces of a run are unlike those that follow,
  // then twice as many each time.
  static constexpr unsigned kFirstPeriod = 32;
  static constexpr unsigned kPeriod = 512;
  static constexpr unsigned kMostPeriod = 16 * kPeriod;  // while sharing is slower each time
  // Pieces that several threads did are late by what they took longer than one thread did; each counts as at most
  // kMostLate pieces, and when kPatience are lost one thread is tried again: it takes longer now if there is more to
  // do, and as long as before if others have taken the cores.
  static constexpr int kMostLate = 4;
  static constexpr int kPatience = 8;

  // Whether several threads do the next piece.
  bool Shares() const { return shares_; }

  // Whether it matters how long the next piece takes. Asking a clock twice costs 2 % of a tick of a few microseconds.
  bool Measures() const { return shares_ || pieces_ < 2 * kTrials; }

  // How long the piece took that was done so; anything if it does not matter.
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
  unsigned pieces_ = 0;                       // of the period
  Duration alone_before_ = Duration::zero();  // when several threads became late; 0 if they are not
  Duration alone_ = Duration::max();
  Duration shared_ = Duration::max();
  Duration late_ = Duration::zero();
};

// Does the ticks of a process whose roles have a pool: with its threads or without. All that a tick has is shared or
// nothing, since threads that have just worked take up the next part at once, and others are to be woken.
class ThreadedTicks
{
public:
  // `pool`: none for one thread. Whoever works in `tick` asks whether it shares.
  template <class Tick>
  void Do(WorkerPool* pool, const Tick& tick)
  {
    if (pool == nullptr || pool->Threads() == 1) return tick();
    pool->Share(choice_.Shares());
    if (!choice_.Measures())
    {
      tick();
      return choice_.Took({});
    }
    const auto start = std::chrono::steady_clock::now();
    tick();
    choice_.Took(std::chrono::steady_clock::now() - start);
  }

private:
  ThreadChoice choice_;
};

}  // namespace swarmanoid
