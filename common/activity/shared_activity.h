// SharedActivity: a step in which several threads run the code of different actors at the same time. If a thread dies,
// the report names the actor of that thread. A reader in another process is told one of the actors that still run.
// ControllerHost uses it.
#pragma once

#include "common/activity/activity.h"

namespace swarmanoid
{

class SharedActivity
{
public:
  static constexpr unsigned kMostThreads = 64;

  // The thread that waits for the others constructs it before they begin.
  SharedActivity(ActivityStep step, std::uint64_t tick);
  ~SharedActivity();
  SharedActivity(const SharedActivity&) = delete;
  SharedActivity& operator=(const SharedActivity&) = delete;

  // While the object lives, this thread is number `number` of the threads that share the step.
  class Thread
  {
  public:
    explicit Thread(unsigned number);
    ~Thread();
    Thread(const Thread&) = delete;
    Thread& operator=(const Thread&) = delete;

    // From now on, this thread runs the code of `actor`.
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
