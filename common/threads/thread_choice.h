// Whether a piece of work that comes again at each tick is done by one thread or by several: by whichever took less
// time lately. Work of a few microseconds wakes nobody, and where other programs need the cores one thread goes on
// alone, also if they come to need them between two trials. For work whose results are the same either way. One thread
// at a time.
#pragma once

#include <algorithm>
#include <chrono>

namespace swarmanoid
{

class ThreadChoice
{
public:
  using Duration = std::chrono::nanoseconds;
  static constexpr Duration kWorthWaking{20'000};  // work that takes less is never shared
  static constexpr unsigned kTrials = 4;           // of each way; the shortest counts
  static constexpr unsigned kLeastGain = 10;       // sharing is worth it if it saves more than one such part
  static constexpr unsigned kPeriod = 512;         // pieces until both ways are tried again
  static constexpr unsigned kMostDoublings = 4;    // of it: one for each time after the first that sharing was slower
  // Pieces that several threads did are late by what they took longer than one thread would; each counts as at most
  // kMostLate pieces, and when kPatience are lost one thread goes on.
  static constexpr int kMostLate = 4;
  static constexpr int kPatience = 8;

  // Whether several threads do the next piece.
  bool Shares() const { return shares_; }

  // How long the piece took that was done so.
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
      if (late_ > kPatience * alone_) shares_ = false;
    }
    if (pieces_ == kTrials) shares_ = alone_ >= kWorthWaking;
    if (pieces_ == 2 * kTrials) shares_ = shares_ && shared_ < alone_ - alone_ / kLeastGain;
    if (pieces_ < kPeriod << (losses_ > 1 ? losses_ - 1 : 0)) return;
    const bool lost = alone_ >= kWorthWaking && !shares_;
    const unsigned losses = lost ? std::min(losses_ + 1, kMostDoublings + 1) : 0;
    *this = ThreadChoice();
    losses_ = losses;
  }

private:
  bool shares_ = false;
  unsigned pieces_ = 0;  // of the period
  Duration alone_ = Duration::max();
  Duration shared_ = Duration::max();
  Duration late_ = Duration::zero();
  unsigned losses_ = 0;  // periods in a row in which sharing was slower
};

// Does a piece of work by one of two functions that do the same.
class SharedWork
{
public:
  template <class Alone, class Shared>
  void Do(const Alone& alone, const Shared& shared)
  {
    const auto start = std::chrono::steady_clock::now();
    if (choice_.Shares())
      shared();
    else
      alone();
    choice_.Took(std::chrono::steady_clock::now() - start);
  }

private:
  ThreadChoice choice_;
};

}  // namespace swarmanoid
