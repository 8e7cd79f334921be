// SharedActivity: a step in which several threads run the code of actors at the same time, each that of others. A
// thread that dies tells whose code it ran itself; whoever asks from outside is told one of those that still run. Used
// by ControllerHost.
#pragma once

#include "common/activity/activity.h"

namespace swarmanoid
{

class SharedActivity
{
public:
  static constexpr unsigned kMostThreads = 64;

  // Before the threads begin, in the thread that waits for them.
  SharedActivity(ActivityStep step, std::uint64_t tick);
  ~SharedActivity();
  SharedActivity(const SharedActivity&) = delete;
  SharedActivity& operator=(const SharedActivity&) = delete;

  // While an object lives, this thread is number `number` of those that share the step.
  class Thread
  {
  public:
    explicit Thread(unsigned number);
    ~Thread();
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    // This thread runs the code of `actor` from now on.
    void Next(const Actor& actor) { place_->store(&actor, std::memory_order_release); }

  private:
    std::atomic<const Actor*>* place_;
  };

private:
  const Actor* outer_actor_;
  ActivityStep outer_step_;
  std::uint64_t outer_tick_;
};

}  // namespace swarmanoid
