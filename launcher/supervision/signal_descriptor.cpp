#include "launcher/supervision/signal_descriptor.h"

#include <sys/signalfd.h>

#include <initializer_list>

namespace swarmanoid
{
namespace
{

// Returns true if the signal is ignored, as nohup(1) does with SIGHUP.
bool IsIgnored(int signal)
{
  struct sigaction action
  {
  };
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

SignalDescriptor::SignalDescriptor()
{
  sigset_t watched;
  sigemptyset(&watched);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (signal != SIGHUP || !IsIgnored(signal)) sigaddset(&watched, signal);
  sigprocmask(SIG_BLOCK, &watched, &before_);
  signals_.Reset(signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK));
  struct sigaction ignore
  {
  };
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &pipe_before_);
}

SignalDescriptor::~SignalDescriptor()
{
  while (Take())
  {
  }
  sigaction(SIGPIPE, &pipe_before_, nullptr);
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

std::optional<int> SignalDescriptor::Take()
{
  signalfd_siginfo received{};
  if (read(signals_.Get(), &received, sizeof received) == static_cast<ssize_t>(sizeof received))
    return static_cast<int>(received.ssi_signo);
  return std::nullopt;
}

}  // namespace swarmanoid
