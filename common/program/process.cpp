#include "common/program/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/program/spawn.h"

namespace swarmanoid
{
namespace
{

// The page on which a process reports its activity: mapped here, with the descriptor that the process inherits.
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
  Pipe input;
  if (!command.input.empty())
  {
    input = MakePipe();
    fcntl(input.read.Get(), F_SETFL, 0);
  }
  PageOfChild page = MakePage();
  SpawnSettings settings{.words = command.arguments, .name = command.name, .environment = command.environment};
  settings.environment.emplace_back(kActivityVariable, std::to_string(page.descriptor.Get()));
  settings.input = input.read.Get();
  settings.output = output.write.Get();
  settings.errors = errors.write.Get();
  settings.kept = page.descriptor.Get();
  settings.cores = command.cores;
  settings.leads_group = true;
  settings.signal_at_our_end = command.signal_at_our_end;
  const pid_t pid = Spawn(settings);
  SpawnedProcess process{pid,
                         std::move(output.read),
                         std::move(errors.read),
                         FileDescriptor(static_cast<int>(syscall(SYS_pidfd_open, pid, 0))),
                         std::move(page.page),
                         std::move(input.write)};
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
  // Processes that it started must not outlive it. Until it is collected, no other group can have its number.
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
