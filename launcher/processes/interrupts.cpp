#include "launcher/processes/interrupts.h"

#include <sys/signalfd.h>

#include <initializer_list>

namespace swarmanoid
{

Interrupts::Interrupts()
{
  sigset_t watched;
  sigemptyset(&watched);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&watched, signal);
  sigprocmask(SIG_BLOCK, &watched, &before_);
  descriptor_.Reset(signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK));
  struct sigaction ignore
  {
  };
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &pipe_before_);
}

Interrupts::~Interrupts()
{
  while (Take())
  {
  }
  sigaction(SIGPIPE, &pipe_before_, nullptr);
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

std::optional<int> Interrupts::Take()
{
  signalfd_siginfo received{};
  if (read(descriptor_.Get(), &received, sizeof received) != static_cast<ssize_t>(sizeof received)) return std::nullopt;
  return static_cast<int>(received.ssi_signo);
}

}  // namespace swarmanoid
