// Handles Ctrl-C, SIGTERM and SIGHUP in programs that end in good order on request. The launcher of a cluster, which
// waits for these signals, has launcher/supervision/signal_descriptor.h instead.
#pragma once

#include <atomic>

namespace swarmanoid
{

// It chooses the effect of a second signal of the same kind.
enum class SecondInterrupt
{
  kSame,  // no further effect: the program ends when it can, for example after it has stopped its robot
  kKills  // ends the program at once, with a report of the code that ran
};

// Makes SIGINT, SIGTERM and SIGHUP set InterruptFlag, and makes writing to a closed pipe an error instead of a death.
// If the signal came because the parent process died (SpawnSettings), the kernel kills this process two seconds later
// if it still runs. Its code may be stuck, and no other process would end it.
void CatchInterrupts(SecondInterrupt second = SecondInterrupt::kSame);
const std::atomic<bool>& InterruptFlag();
inline bool Interrupted() { return InterruptFlag(); }

}  // namespace swarmanoid
