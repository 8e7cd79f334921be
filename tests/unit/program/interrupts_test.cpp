// A process that is stuck does not outlive the process that started it.
#include "common/program/interrupts.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "common/program/file_descriptor.h"

namespace swarmanoid
{
namespace
{

constexpr int kGenerous_ms = 60'000;

TEST(CatchInterrupts, AStuckProcessEndsWithTheProcessThatStartedIt)
{
  Pipe ready = MakePipe();
  fcntl(ready.read.Get(), F_SETFL, 0);
  const pid_t starter = fork();
  if (starter == 0)
  {
    const pid_t stuck = fork();
    if (stuck == 0)
    {
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      CatchInterrupts();
      const pid_t self = getpid();
      [[maybe_unused]] const ssize_t written = write(ready.write.Get(), &self, sizeof self);
      while (true) pause();
    }
    while (true) pause();
  }
  pid_t stuck = 0;
  ASSERT_EQ(read(ready.read.Get(), &stuck, sizeof stuck), static_cast<ssize_t>(sizeof stuck));
  const FileDescriptor end(static_cast<int>(syscall(SYS_pidfd_open, stuck, 0)));
  ASSERT_TRUE(end.IsOpen());

  kill(starter, SIGKILL);
  waitpid(starter, nullptr, 0);
  pollfd entry{end.Get(), POLLIN, 0};
  EXPECT_EQ(poll(&entry, 1, kGenerous_ms), 1);
  kill(stuck, SIGKILL);
}

}  // namespace
}  // namespace swarmanoid
