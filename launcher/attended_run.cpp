#include "launcher/attended_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "common/activity/exit_codes.h"
#include "common/activity/failure_report.h"
#include "common/activity/print_error.h"
#include "common/bus/run_directory.h"
#include "common/program/process.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kEndOfKilled{10};

[[noreturn]] void Supervise(const ConsoleSetup& setup, ConsoleLink link, const Supervisor::GoOn& go_on,
                            const std::function<int(const Attendance&)>& work)
{
  const pid_t launcher = getppid();
  // Neither the end of the terminal nor Ctrl-C is for this process.
  setsid();
  const FileDescriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
  dup2(nothing.Get(), STDIN_FILENO);
  int code = kExitProcessFailed;
  try
  {
    Console console(setup, std::move(link), launcher);
    code = work({&console, go_on});
    console.End(code);
  }
  catch (const UsageError& error)
  {
    PrintError("swarmanoid: {}\n", error.what());
    code = kExitUsage;
  }
  catch (const std::exception& error)
  {
    PrintError("swarmanoid: {}\n", error.what());
  }
  LeaveAtOnce(code);
}

// The kernel kills the processes of a run with the one that supervises them; they become children of this process.
void AwaitKilled()
{
  const auto deadline = Clock::now() + kEndOfKilled;
  while (Clock::now() < deadline)
  {
    const pid_t ended = waitpid(-1, nullptr, WNOHANG);
    if (ended < 0 && errno != EINTR) return;
    if (ended == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

ProcessEnd EndOf(pid_t process)
{
  // Its socket, if it was killed: until it is collected, nobody else has its number.
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR)
  {
  }
  unlink(ConsoleSocketOf(process).c_str());
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR)
  {
  }
  ProcessEnd end;
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

}  // namespace

Attended Attend(ConsoleLink& link, Interrupts& interrupts)
{
  Attended attended;
  while (true)
  {
    pollfd entries[]{{link.Descriptor(), POLLIN, 0}, {interrupts.Descriptor(), POLLIN, 0}};
    poll(entries, 2, -1);
    while (const auto signal = interrupts.Take())
    {
      // The terminal is lost. What supervises the run notices.
      if (*signal == SIGHUP) LeaveAtOnce(kExitInterrupted);
      attended.asked = true;
      link.Send({{"signal", *signal}});
    }
    while (auto received = link.Receive())
    {
      if (received->ended) return attended;
      if (!received->message) continue;
      const auto& code = (*received->message)["exit_code"];
      if (code.is_number_integer()) attended.exit_code = code.get<int>();
    }
  }
}

int RunAttended(const ConsoleSetup& setup, unsigned retries, const std::function<int(const Attendance&)>& work)
{
  // From here on nothing that is meant for the run ends this process alone.
  Interrupts interrupts;
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  RemoveDeadConsoles();
  const auto start = Clock::now();
  for (unsigned again = 0;; ++again)
  {
    auto [ours, theirs] = ConsoleLink::MakePair();
    std::fflush(nullptr);
    const double taken_s = std::chrono::duration<double>(Clock::now() - start).count();
    const pid_t supervisor = fork();
    if (supervisor < 0)
      throw std::runtime_error(
          fmt::format("cannot start the process that supervises the run: {}", std::strerror(errno)));
    if (supervisor == 0)
    {
      {
        const ConsoleLink closed = std::move(ours);
      }
      Supervise(setup, std::move(theirs), {again > 0 ? 1U : 0U, taken_s}, work);
    }
    {
      const ConsoleLink closed = std::move(theirs);
    }
    const Attended attended = Attend(ours, interrupts);
    const ProcessEnd end = EndOf(supervisor);
    if (end.signal == 0) return end.exit_code;
    AwaitKilled();
    RemoveDeadRuns();
    const std::string text = fmt::format("the process that supervises the run {}", end.Text());
    if (attended.asked || again >= retries)
    {
      PrintError("{}, and the run with it; to go on with it: swarmanoid resume {}\n", text, setup.folder);
      return kExitProcessFailed;
    }
    PrintError("{}; all processes start again where the journal ends\n", text);
  }
}

}  // namespace swarmanoid
