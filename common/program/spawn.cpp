#include "common/program/spawn.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "common/program/file_descriptor.h"

extern char** environ;

namespace swarmanoid
{
namespace
{

std::vector<std::string> EnvironmentWith(const std::vector<std::pair<std::string, std::string>>& additions)
{
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry)
  {
    const std::string_view text = *entry;
    bool replaced = false;
    for (const auto& [name, value] : additions) replaced |= text.starts_with(name + "=");
    if (!replaced) environment.emplace_back(text);
  }
  for (const auto& [name, value] : additions) environment.push_back(name + "=" + value);
  return environment;
}

std::vector<char*> Pointers(std::vector<std::string>& texts)
{
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Connects a descriptor to a standard one. A negative descriptor stands for /dev/null. Returns -1 on failure.
int Connect(int descriptor, int standard)
{
  const int from = descriptor >= 0 ? descriptor : open("/dev/null", O_RDWR);
  // If this process has closed standard descriptors, other files may have their numbers.
  if (from == standard) return fcntl(from, F_SETFD, 0);
  return from < 0 ? -1 : dup2(from, standard);
}

// Runs between fork and exec, with system calls only. Returns errno if a call fails. posix_spawn can set neither a
// death signal nor cores.
int BecomeProgram(const SpawnSettings& settings, pid_t parent, const cpu_set_t& cores, char** arguments,
                  char** environment)
{
  if (settings.signal_at_our_end != 0)
  {
    prctl(PR_SET_PDEATHSIG, settings.signal_at_our_end);
    if (getppid() != parent) return ESRCH;
  }
  if (settings.leads_group) setpgid(0, 0);
  struct sigaction as_ever = {};
  as_ever.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) sigaction(signal, &as_ever, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!settings.cores.empty()) sched_setaffinity(0, sizeof cores, &cores);
  if (Connect(settings.input, STDIN_FILENO) < 0 || Connect(settings.output, STDOUT_FILENO) < 0 ||
      Connect(settings.errors, STDERR_FILENO) < 0)
    return errno;
  // Other descriptors, such as sockets of a library, would stay open as long as the program lives.
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  if (settings.kept >= 0) fcntl(settings.kept, F_SETFD, 0);
  execvpe(arguments[0], arguments, environment);
  return errno;
}

[[noreturn]] void CannotStart(const SpawnSettings& settings, int error)
{
  throw std::runtime_error(fmt::format("cannot start {}{}'{}': {}", settings.name, settings.name.empty() ? "" : ": ",
                                       settings.words[0], std::strerror(error)));
}

}  // namespace

pid_t Spawn(const SpawnSettings& settings)
{
  Pipe failure = MakePipe();
  fcntl(failure.read.Get(), F_SETFL, 0);
  std::vector<std::string> words = settings.words;
  const std::vector<char*> arguments = Pointers(words);
  std::vector<std::string> variables = EnvironmentWith(settings.environment);
  const std::vector<char*> environment = Pointers(variables);
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (const int core : settings.cores) CPU_SET(static_cast<std::size_t>(core), &cores);

  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) CannotStart(settings, errno);
  if (process == 0)
  {
    const int error = BecomeProgram(settings, parent, cores, const_cast<char**>(arguments.data()),
                                    const_cast<char**>(environment.data()));
    [[maybe_unused]] const ssize_t written = write(failure.write.Get(), &error, sizeof error);
    _exit(127);
  }
  if (settings.leads_group) setpgid(process, process);
  failure.write.Reset();
  // The pipe closes without data when exec succeeds.
  int error = 0;
  ssize_t got = 0;
  while ((got = read(failure.read.Get(), &error, sizeof error)) < 0 && errno == EINTR) continue;
  if (got != sizeof error) return process;
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) continue;
  CannotStart(settings, error);
}

}  // namespace swarmanoid
