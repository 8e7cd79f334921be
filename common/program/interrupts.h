// Ctrl-C and its kin, for programs that end in good order when asked to. The launcher of a cluster, which waits for
// them, has launcher/supervision/signal_descriptor.h instead.
#pragma once

#include <atomic>

namespace swarmanoid
{

// What a second signal of the same kind does.
enum class SecondInterrupt
{
  kSame,  // nothing new: the program ends when it can, as a robot does, which must be stopped first
  kKills  // ends the program at once, which says whose code ran
};

// From here on SIGINT, SIGTERM and SIGHUP set InterruptFlag, and writing to a closed pipe is an error instead of a
// death. If this process gets one of them because the process that started it has died (SpawnSettings), the kernel
// kills it two seconds later if it still runs: its code may be stuck, and no other process would end it.
void CatchInterrupts(SecondInterrupt second = SecondInterrupt::kSame);
const std::atomic<bool>& InterruptFlag();
inline bool Interrupted() { return InterruptFlag(); }

}  // namespace swarmanoid
