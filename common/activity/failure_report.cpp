#include "common/activity/failure_report.h"

#include <cxxabi.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <initializer_list>
#include <new>

#include "common/activity/current_activity.h"
#include "common/activity/exit_calls.h"
#include "common/activity/signal_stack.h"
#include "common/errors/exit_codes.h"
#include "common/memory/memory_limit.h"
#include "common/memory/shared_memory.h"

namespace swarmanoid
{
namespace
{

// Sanitizers report crashes themselves, with the position in the source.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kReportCrashes = false;
#else
constexpr bool kReportCrashes = true;
#endif

char process_name[128] = "swarmanoid";
std::atomic<pid_t> dying = 0;  // the thread that reports the death of the process
std::atomic<LastCall> last_call = nullptr;
std::atomic<const char*> cure_of_step = "";

std::uint64_t Nanoseconds()
{
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec);
}

// Writes "<activity> <what>" or, if the activity is not the cause, "<process> <what> …".
void Compose(LineWriter& line, std::string_view what, bool of_activity)
{
  const activity::Current now = activity::Now();
  if (now.actor != nullptr && of_activity)
  {
    activity::Write(line, *now.actor, now.step, now.tick);
    line.Add(" ").Add(what);
    line.Add(cure_of_step.load(std::memory_order_relaxed));
    return;
  }
  line.Add(process_name).Add(" ").Add(what);
  if (now.actor == nullptr)
  {
    line.Add(" at tick ").Add(OwnActivityPage().tick.load(std::memory_order_relaxed));
    return;
  }
  line.Add(", in a thread of its own, during ");
  activity::Write(line, *now.actor, now.step, now.tick);
}

void CallLast(std::string_view line, int exit_code)
{
  if (const LastCall call = last_call.exchange(nullptr)) call(line, exit_code);
}

void Report(std::string_view what, bool of_activity, int exit_code = kExitProcessFailed)
{
  const pid_t thread = static_cast<pid_t>(syscall(SYS_gettid));
  pid_t none = 0;
  if (!dying.compare_exchange_strong(none, thread))
  {
    if (none == thread) syscall(SYS_exit_group, kExitProcessFailed);
    while (true) pause();
  }
  LineWriter line;
  Compose(line, what, of_activity);
  NoteEnd(EndReason::kDied, OwnActivityPage().tick.load(std::memory_order_relaxed), line.Text(),
          activity::Now().actor != nullptr);
  // Removes what a progress line left on a terminal.
  if (isatty(STDERR_FILENO) != 0) WriteAll(STDERR_FILENO, "\r\033[K");
  WriteAll(STDERR_FILENO, line.Text());
  WriteAll(STDERR_FILENO, "\n");
  CallLast(line.Text(), exit_code);
}

// Makes a copy of the process, with the same memory and this thread, that dies by the signal and leaves a core file.
// The process itself continues to its end. Returns true in the copy.
bool DumpsCore()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_CORE, &limit) != 0 || limit.rlim_cur == 0) return false;
  const long copy = syscall(SYS_clone, 0, nullptr, nullptr, nullptr, nullptr);
  if (copy == 0) return true;
  if (copy > 0) waitpid(static_cast<pid_t>(copy), nullptr, __WALL);
  return false;
}

void WhatHappened(LineWriter& what, int signal, const siginfo_t& about)
{
  const char* description = sigdescr_np(signal);
  const auto address = reinterpret_cast<std::uintptr_t>(about.si_addr);
  const bool fault = about.si_code > 0 && (signal == SIGSEGV || signal == SIGBUS);
  if (fault && IsStackOverflow(address))
  {
    what.Add("overflowed its stack");
    return;
  }
  if (signal == SIGABRT && about.si_code <= 0 && about.si_pid == getpid())
  {
    what.Add("aborted");
    return;
  }
  what.Add("crashed by signal ").Add(static_cast<std::uint64_t>(signal)).Add(" (").Add(description).Add(")");
  if (fault && signal == SIGBUS && SharedMemoryIsFull())
    what.Add(": ")
        .Add(SharedMemoryFolder())
        .Add(" is full; free some of it, or let SWARMANOID_SHARED_FOLDER name a folder with more room");
  else if (fault)
    what.Add(" at address 0x").Add(address, 16);
  else if (about.si_code <= 0 && about.si_pid != getpid())
    what.Add(", sent by process ").AddSigned(about.si_pid);
}

void OnDeadlySignal(int signal, siginfo_t* about, void*)
{
  LineWriter what;
  WhatHappened(what, signal, *about);
  Report(what.Text(), activity::IsMine());
  if (DumpsCore())
  {
    struct sigaction usual
    {
    };
    usual.sa_handler = SIG_DFL;
    sigaction(signal, &usual, nullptr);
    if (about->si_code <= 0) kill(getpid(), signal);
    return;  // returns to the instruction that failed
  }
  syscall(SYS_exit_group, kExitProcessFailed);
}

void OnTerminate()
{
  if (!std::current_exception()) DieOf("called std::terminate");
  DieOf("ended by an uncaught exception: " + CurrentExceptionText());
}

std::string TypeName(const std::type_info& type)
{
  int failed = 0;
  char* readable = abi::__cxa_demangle(type.name(), nullptr, nullptr, &failed);
  const std::string name = failed == 0 ? readable : type.name();
  std::free(readable);
  return name;
}

}  // namespace

bool WriteAll(int file, std::string_view text)
{
  while (!text.empty())
  {
    const ssize_t written = write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void ReportDeaths(const std::string& process)
{
  const std::size_t length = std::min(process.size(), sizeof process_name - 1);
  std::memcpy(process_name, process.data(), length);
  process_name[length] = 0;
  OwnActivityPage();

  static const bool once = []
  {
    EnsureSignalStack();
    WatchExit();
    std::set_terminate(OnTerminate);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    {
      if (!kReportCrashes && signal != SIGABRT) continue;
      struct sigaction action
      {
      };
      if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
      action.sa_sigaction = OnDeadlySignal;
      action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
      sigaction(signal, &action, nullptr);
    }
    return true;
  }();
  static_cast<void>(once);
}

void NoteEnd(EndReason reason, std::uint64_t tick, std::string_view text, bool complete)
{
  static std::atomic<EndReason> noted = EndReason::kUnknown;
  EndReason before = EndReason::kUnknown;
  if (!noted.compare_exchange_strong(before, reason))
  {
    const bool worse = before == EndReason::kDone && (reason == EndReason::kFailed || reason == EndReason::kDied);
    if (!worse || !noted.compare_exchange_strong(before, reason)) return;
  }
  ActivityPage& page = OwnActivityPage();
  const std::size_t length = std::min(text.size(), ActivityPage::kCauseSize - 1);
  std::memcpy(page.cause, text.data(), length);
  page.cause[length] = 0;
  page.tick.store(tick, std::memory_order_relaxed);
  page.complete.store(complete ? 1 : 0, std::memory_order_relaxed);
  page.ended_ns.store(Nanoseconds(), std::memory_order_relaxed);
  page.end.store(static_cast<std::uint32_t>(reason), std::memory_order_release);
}

void LeaveAtOnce(int code)
{
  std::fflush(nullptr);
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}

void DieOf(std::string_view what)
{
  Report(what, activity::IsMine());
  syscall(SYS_exit_group, kExitProcessFailed);
  __builtin_unreachable();
}

void DieOfStep(std::string_view what)
{
  Report(what, true);
  syscall(SYS_exit_group, kExitProcessFailed);
  __builtin_unreachable();
}

void DieInterrupted()
{
  if (activity::Now().actor != nullptr) Report("was killed by the user", true, kExitInterrupted);
  CallLast({}, kExitInterrupted);
  syscall(SYS_exit_group, kExitInterrupted);
  __builtin_unreachable();
}

void SetCureOfStep(const char* cure) { cure_of_step.store(cure, std::memory_order_relaxed); }

void SetLastCall(LastCall call) { last_call = call; }

std::string CurrentExceptionText()
{
  try
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    return OutOfMemoryText();
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  catch (const abi::__forced_unwind&)
  {
    throw;
  }
  catch (const char* text)
  {
    return text == nullptr ? "a null pointer" : text;
  }
  catch (const std::string& text)
  {
    return text;
  }
  catch (int number)
  {
    return "the number " + std::to_string(number) + " was thrown";
  }
  catch (...)
  {
    return "an exception of type " + TypeName(*abi::__cxa_current_exception_type());
  }
}

void RethrowFor(const Actor& actor, ActivityStep step, std::uint64_t tick)
{
  try
  {
    throw;
  }
  catch (const ActivityError&)
  {
    throw;
  }
  catch (...)
  {
  }
  const std::string text = CurrentExceptionText();
  throw ActivityError(ActivityText(actor, step, tick) + " failed: " + text);
}

}  // namespace swarmanoid
