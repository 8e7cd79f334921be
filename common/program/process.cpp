#include "common/program/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

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

// The page by which a process says what it does: mapped here, and the descriptor that the process inherits.
struct PageOfChild
{
  FileDescriptor descriptor;
  std::shared_ptr<const ActivityPage> page;
};

PageOfChild MakePage()
{
  PageOfChild made;
  made.descriptor.Reset(memfd_create("swarmanoid_activity", MFD_CLOEXEC));
  if (!made.descriptor.IsOpen() || ftruncate(made.descriptor.Get(), sizeof(ActivityPage)) != 0) return {};
  void* memory = mmap(nullptr, sizeof(ActivityPage), PROT_READ | PROT_WRITE, MAP_SHARED, made.descriptor.Get(), 0);
  if (memory == MAP_FAILED) return {};
  auto* page = static_cast<ActivityPage*>(memory);
  page->magic = ActivityPage::kMagic;
  made.page =
      std::shared_ptr<const ActivityPage>(page, [memory](const void*) { munmap(memory, sizeof(ActivityPage)); });
  return made;
}

// The part between fork and exec: system calls only. Returns errno if one fails.
int BecomeChild(pid_t launcher, const cpu_set_t* cores, int input, int output, int errors, int page, char** arguments,
                char** environment)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != launcher) return ESRCH;
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  signal(SIGPIPE, SIG_DFL);
  if (cores != nullptr) sched_setaffinity(0, sizeof *cores, cores);
  const int nothing = input >= 0 ? input : open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(output, 1) < 0 || dup2(errors, 2) < 0) return errno;
  if (nothing > 2) close(nothing);
  // Sockets of a library, for one, which would be taken as long as the child lives.
  close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  if (page >= 0) fcntl(page, F_SETFD, 0);
  execvpe(arguments[0], arguments, environment);
  return errno;
}

}  // namespace

std::string ProcessEnd::Text() const
{
  if (signal != 0) return fmt::format("was killed by signal {} ({})", signal, strsignal(signal));
  if (exit_code != 0) return fmt::format("ended with exit code {}", exit_code);
  return "ended";
}

SpawnedProcess SystemSpawner::Start(const ProcessCommand& command)
{
  Pipe output = MakePipe();
  Pipe errors = MakePipe();
  Pipe failure = MakePipe();
  Pipe input;
  if (!command.input.empty())
  {
    input = MakePipe();
    fcntl(input.read.Get(), F_SETFL, 0);
  }
  fcntl(failure.read.Get(), F_SETFL, 0);
  std::vector<std::string> argument_texts = command.arguments;
  std::vector<char*> arguments = Pointers(argument_texts);
  PageOfChild page = MakePage();
  std::vector<std::pair<std::string, std::string>> additions = command.environment;
  additions.emplace_back(kActivityVariable, std::to_string(page.descriptor.Get()));
  std::vector<std::string> environment_texts = EnvironmentWith(additions);
  std::vector<char*> environment = Pointers(environment_texts);
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (const int core : command.cores) CPU_SET(static_cast<std::size_t>(core), &cores);

  const pid_t launcher = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(fmt::format("cannot start {}: {}", command.name, std::strerror(errno)));
  if (pid == 0)
  {
    const int error =
        BecomeChild(launcher, command.cores.empty() ? nullptr : &cores, input.read.Get(), output.write.Get(),
                    errors.write.Get(), page.descriptor.Get(), arguments.data(), environment.data());
    [[maybe_unused]] const ssize_t written = write(failure.write.Get(), &error, sizeof error);
    _exit(127);
  }
  setpgid(pid, pid);
  failure.write.Reset();
  SpawnedProcess process{pid,
                         std::move(output.read),
                         std::move(errors.read),
                         FileDescriptor(static_cast<int>(syscall(SYS_pidfd_open, pid, 0))),
                         std::move(page.page),
                         std::move(input.write)};

  // The pipe closes without a word when exec succeeds.
  int error = 0;
  if (read(failure.read.Get(), &error, sizeof error) == sizeof error)
  {
    Collect(process);
    throw std::runtime_error(
        fmt::format("cannot start {}: '{}': {}", command.name, command.arguments.front(), std::strerror(error)));
  }
  if (!process.end.IsOpen())
  {
    Signal(process, SIGKILL);
    Collect(process);
    throw std::runtime_error("cannot watch processes: this system has no pidfd_open (Linux 5.3 or newer is needed)");
  }
  return process;
}

ProcessEnd SystemSpawner::Collect(const SpawnedProcess& process)
{
  // What it started itself must not outlive it. As long as it is not collected, no other group can have its number.
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(process.pid), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR)
  {
  }
  Signal(process, SIGKILL);
  int status = 0;
  while (waitpid(process.pid, &status, 0) < 0 && errno == EINTR)
  {
  }
  ProcessEnd end;
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

void SystemSpawner::Signal(const SpawnedProcess& process, int signal) { kill(-process.pid, signal); }

std::vector<int> AvailableCores()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  return cores;
}

}  // namespace swarmanoid
