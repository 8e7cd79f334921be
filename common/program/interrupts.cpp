#include "common/program/interrupts.h"

#include <signal.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

#include <csignal>

#include "common/activity/failure_report.h"

namespace swarmanoid
{
namespace
{

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// The time that a process gets to end after its parent has ended.
constexpr time_t kLastMoments_s = 2;
// Both variables are set before the signals are caught.
volatile pid_t starter = 0;  // 0: the parent's end is not awaited
timer_t last_moments{};

void AwaitEndOfStarter()
{
  int signal = 0;
  if (prctl(PR_GET_PDEATHSIG, &signal) != 0 || signal == 0) return;
  sigevent kill{};
  kill.sigev_notify = SIGEV_SIGNAL;
  kill.sigev_signo = SIGKILL;
  if (timer_create(CLOCK_MONOTONIC, &kill, &last_moments) == 0) starter = getppid();
}

// Signal handlers call it. It returns whether this was the first signal.
bool Interrupt()
{
  if (starter != 0 && getppid() != starter)
  {
    starter = 0;
    itimerspec at{};
    at.it_value.tv_sec = kLastMoments_s;
    timer_settime(last_moments, 0, &at, nullptr);
  }
  return !interrupted.exchange(true);
}

}  // namespace

void CatchInterrupts(SecondInterrupt second)
{
  struct sigaction action
  {
  };
  action.sa_handler = [](int) { Interrupt(); };
  if (second == SecondInterrupt::kKills)
  {
    action.sa_handler = [](int)
    {
      if (!Interrupt()) DieInterrupted();
    };
    action.sa_flags = static_cast<int>(SA_RESTART | SA_ONSTACK);
  }
  AwaitEndOfStarter();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

const std::atomic<bool>& InterruptFlag() { return interrupted; }

}  // namespace swarmanoid
