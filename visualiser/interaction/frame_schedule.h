// Decides when a window draws: at every n-th tick, at most at a given rate, and between ticks while a user acts.
// Renderers with a window use it. Times are seconds of a monotonic clock.
#pragma once

#include <cstdint>

namespace swarmanoid
{

class FrameSchedule
{
public:
  FrameSchedule(std::uint64_t every, double max_rate, bool all_frames)
      : every_(every), period_(1 / max_rate), all_frames_(all_frames)
  {
  }

  // Returns whether the picture of a new tick must be drawn now. Ticks that come too early are drawn by Idle.
  bool AtTick(std::uint64_t tick, double now)
  {
    if (tick < next_) return false;
    next_ = tick - tick % every_ + every_;
    stale_ = true;
    return all_frames_ || now >= last_ + period_;
  }
  // Returns whether to draw between ticks.
  bool AtIdle(double now) const
  {
    const bool wanted = stale_ || frames_wanted_ > 0 || now < active_until_ || now >= last_ + kResting;
    return wanted && now >= last_ + period_;
  }
  // The user moved the mouse or pressed a key, so that panels and camera must react for a while.
  void Activity(double now)
  {
    active_until_ = now + kActive;
    frames_wanted_ = kFramesOfAnEvent;
  }
  void Drawn(double now)
  {
    last_ = now;
    stale_ = false;
    if (frames_wanted_ > 0) --frames_wanted_;
  }

private:
  static constexpr double kActive = 0.4;
  // This holds however slow pictures are, since a panel needs several frames for a click.
  static constexpr int kFramesOfAnEvent = 4;
  static constexpr double kResting = 1;  // the period at which panels refresh the state of the run

  std::uint64_t every_;
  double period_;
  bool all_frames_;
  std::uint64_t next_ = 0;
  double last_ = -1e9;
  double active_until_ = -1e9;
  int frames_wanted_ = 0;
  bool stale_ = true;
};

}  // namespace swarmanoid
