#include "launcher/processes/interrupts.h"

#include <sys/epoll.h>
#include <sys/signalfd.h>

#include <initializer_list>

#include "launcher/processes/console.h"

namespace swarmanoid
{
namespace
{

// For the end of the other process, where both were ended by the same terminal.
constexpr std::chrono::milliseconds kEndOfConsole{300};

// As nohup(1) has it for SIGHUP.
bool IsIgnored(int signal)
{
  struct sigaction action
  {
  };
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

Interrupts::Interrupts(Console* console) : console_(console), descriptor_(epoll_create1(EPOLL_CLOEXEC))
{
  sigset_t watched;
  sigemptyset(&watched);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (signal != SIGHUP || !IsIgnored(signal)) sigaddset(&watched, signal);
  sigprocmask(SIG_BLOCK, &watched, &before_);
  signals_.Reset(signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK));
  epoll_event event{};
  event.events = EPOLLIN;
  for (const int watch : {signals_.Get(), console != nullptr ? console->Descriptor() : -1})
    if (watch >= 0) epoll_ctl(descriptor_.Get(), EPOLL_CTL_ADD, watch, &event);
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
  if (read(signals_.Get(), &received, sizeof received) == static_cast<ssize_t>(sizeof received))
    return static_cast<int>(received.ssi_signo);
  return console_ != nullptr ? console_->TakeSignal() : std::nullopt;
}

bool Interrupts::ConsoleHasGone() { return console_ != nullptr && console_->HasGone(kEndOfConsole); }

}  // namespace swarmanoid
