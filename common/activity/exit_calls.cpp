#include "common/activity/exit_calls.h"

#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "common/activity/current_activity.h"
#include "common/activity/failure_report.h"

namespace swarmanoid
{
namespace
{

void DieIfInside(const char* function, int code)
{
  if (!activity::IsMine()) return;
  LineWriter what;
  what.Add("called ").Add(function).Add("(").AddSigned(code).Add(")");
  DieOf(what.Text());
}

[[noreturn]] void GoOn(const char* function, int code)
{
  using Exit = void (*)(int);
  if (const auto next = reinterpret_cast<Exit>(dlsym(RTLD_NEXT, function))) next(code);
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}

}  // namespace

void WatchExit()
{
  on_exit([](int code, void*) { DieIfInside("exit", code); }, nullptr);
}

}  // namespace swarmanoid

// The functions have GNU attributes, since Clang takes the standard ones only on a first declaration.
extern "C"
{
  __attribute__((noreturn)) void exit(int code) noexcept
  {
    if (swarmanoid::activity::IsMine()) std::fflush(nullptr);
    swarmanoid::DieIfInside("exit", code);
    swarmanoid::GoOn("exit", code);
  }

  __attribute__((noreturn)) void quick_exit(int code) noexcept
  {
    swarmanoid::DieIfInside("quick_exit", code);
    swarmanoid::GoOn("quick_exit", code);
  }

  __attribute__((noreturn)) void _exit(int code)
  {
    swarmanoid::DieIfInside("_exit", code);
    syscall(SYS_exit_group, code);
    __builtin_unreachable();
  }

  __attribute__((noreturn)) void _Exit(int code) noexcept
  {
    swarmanoid::DieIfInside("_Exit", code);
    syscall(SYS_exit_group, code);
    __builtin_unreachable();
  }
}
