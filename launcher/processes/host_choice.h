// HostChoice: how many controller hosts a run is to have, for --controller-hosts auto: it begins with one, and has one
// more as long as that pays. Used by the supervisor, which tells it of ticks and starts the run again with the next
// number.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace swarmanoid
{

class HostChoice
{
public:
  using Clock = std::chrono::steady_clock;

  // `most`: cores that are free for them, robots.
  explicit HostChoice(unsigned most) : most_(most), over_(most < 2) {}

  // The run is at the tick. With how many hosts it is to go on, if not with as many as now.
  std::optional<unsigned> Take(std::uint64_t tick, Clock::time_point now);
  // What was measured since the last Take that gave a number counts for nothing: the run was paused, or starts again.
  void Disturbed() { begun_.reset(); }
  // It has decided, and Text says what. Nothing changes any more.
  bool IsOver() const { return over_; }
  // "controller hosts: 2 (1204 ticks a second; 812 with 1, 1190 with 3)"
  std::string Text() const;

private:
  struct Begin
  {
    Clock::time_point at;
    std::optional<std::uint64_t> tick;  // once the run has settled
  };

  unsigned most_;
  bool over_;
  unsigned chosen_ = 1;
  std::optional<Begin> begun_;
  std::vector<double> rates_;  // ticks a second, with one host, two …
};

}  // namespace swarmanoid
