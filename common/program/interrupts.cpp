#include "common/program/interrupts.h"

#include <csignal>

#include "common/activity/failure_report.h"

namespace swarmanoid
{
namespace
{

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void CatchInterrupts(SecondInterrupt second)
{
  struct sigaction action
  {
  };
  action.sa_handler = [](int) { interrupted = true; };
  if (second == SecondInterrupt::kKills)
  {
    action.sa_handler = [](int)
    {
      if (interrupted.exchange(true)) DieInterrupted();
    };
    action.sa_flags = static_cast<int>(SA_RESTART | SA_ONSTACK);
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

const std::atomic<bool>& InterruptFlag() { return interrupted; }

}  // namespace swarmanoid
