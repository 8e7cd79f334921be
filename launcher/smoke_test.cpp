#include "launcher/smoke_test.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/activity/failure_report.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/simulator.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// The result goes into the pipe, since users' code may end the process with any exit code.
int TryHere(const Experiment& experiment, const Trial& trial)
{
  try
  {
    SimulatorOptions options;
    options.output_folder = trial.folder;
    options.visualisations = false;
    CSimulator simulator(experiment, options);
    for (int step = 0; step < trial.steps; ++step) simulator.Step();
    if (trial.visualisations)
      for (const RenderConfiguration& render : experiment.visualisations) MakeRenderer(render);
    return kExitDone;
  }
  catch (const ConfigurationError& error)
  {
    PrintError("{}\n", error.what());
    return kExitInvalidFile;
  }
  catch (const std::exception& error)
  {
    PrintError("{}\n", error.what());
    return kExitProcessFailed;
  }
  catch (...)
  {
    PrintError("the start threw what is no std::exception\n");
    return kExitProcessFailed;
  }
}

// Waits until the process has ended and its end of the pipe is closed. Returns false if that takes longer than `most`.
bool Ended(int pipe, std::chrono::seconds most)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point last = Clock::now() + most;
  while (true)
  {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(last - Clock::now());
    pollfd end{pipe, POLLIN, 0};
    const int ready = poll(&end, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready > 0) return true;
    if (ready == 0) return false;
  }
}

}  // namespace

int SmokeTest(const Experiment& experiment, bool visualisations)
{
  const ScratchFolder folder;
  return TryRun(experiment, {.folder = folder.Path(), .visualisations = visualisations});
}

int TryRun(const Experiment& experiment, const Trial& trial)
{
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("cannot make a pipe: ") + std::strerror(errno));
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
  if (child == 0)
  {
    close(ends[0]);
    if (const int nowhere = trial.is_silent ? open("/dev/null", O_WRONLY) : -1; nowhere >= 0)
      dup2(nowhere, STDERR_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    const auto code = static_cast<char>(TryHere(experiment, trial));
    std::fflush(nullptr);
    LeaveAtOnce(write(ends[1], &code, 1) == 1 ? 0 : 1);
  }
  close(ends[1]);
  const bool in_time = Ended(ends[0], trial.most);
  char code = 0;
  const bool said = in_time && read(ends[0], &code, 1) == 1;
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    ;
  if (trial.is_silent) return said && WIFEXITED(status) ? code : static_cast<int>(kExitProcessFailed);
  if (!in_time)
    PrintError("the start takes longer than {} s; does Init of a controller return?\n", trial.most.count());
  else if (WIFSIGNALED(status))
    PrintError("the start was ended by signal {} ({}); does Init of a controller crash?\n", WTERMSIG(status),
               strsignal(WTERMSIG(status)));
  else if (!said && WEXITSTATUS(status) != kExitProcessFailed)
    PrintError("the start was ended by exit({}); does Init of a controller call it?\n", WEXITSTATUS(status));
  return said && WIFEXITED(status) ? code : static_cast<int>(kExitProcessFailed);
}

}  // namespace swarmanoid
