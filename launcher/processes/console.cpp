#include "launcher/processes/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "common/activity/print_error.h"
#include "common/configuration/output_file.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kMostOthers = 16;
constexpr auto kAgain = 1s;

double Seconds(Console::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

FileDescriptor ListenAt(const std::string& path)
{
  const auto refuse = [&](const std::string& why)
  {
    throw std::runtime_error(fmt::format(
        "cannot make the socket '{}', by which `swarmanoid adopt` finds the run: {}; name another folder by "
        "XDG_RUNTIME_DIR, or let the run end with its launcher: --orphan-timeout 0",
        path, why));
  };
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // Under its name it listens: one there that refuses is of a process that has died.
  const std::string unfinished = path + ".new";
  if (unfinished.size() >= sizeof address.sun_path) refuse("its path is too long");
  unfinished.copy(address.sun_path, unfinished.size());
  unlink(unfinished.c_str());
  FileDescriptor listener(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!listener.IsOpen() || bind(listener.Get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener.Get(), kMostOthers) != 0 || std::rename(unfinished.c_str(), path.c_str()) != 0)
    refuse(std::strerror(errno));
  return listener;
}

// What is written there from now on goes where `file` does.
void Redirect(int output, int errors)
{
  std::fflush(stdout);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
}

}  // namespace

Console::Console(ConsoleSetup setup, ConsoleLink first, pid_t launcher)
    : setup_(std::move(setup)),
      path_(ConsoleSocketOf(getpid())),
      events_(epoll_create1(EPOLL_CLOEXEC)),
      listener_(ListenAt(path_)),
      console_(std::move(first)),
      console_process_(launcher)
{
  Watch(listener_.Get());
  Watch(console_->Descriptor());
}

Console::~Console() { unlink(path_.c_str()); }

void Console::Watch(int descriptor) const
{
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = descriptor;
  if (epoll_ctl(events_.Get(), EPOLL_CTL_ADD, descriptor, &event) != 0)
    throw std::runtime_error(fmt::format("cannot watch the console of the run: {}", std::strerror(errno)));
}

std::optional<int> Console::TakeSignal()
{
  HearConsole();
  HearOthers();
  if (!signals_.empty())
  {
    const int signal = signals_.front();
    signals_.erase(signals_.begin());
    return signal;
  }
  const auto now = Clock::now();
  if (!orphaned_ || now - *orphaned_ < setup_.orphan_timeout || (told_end_ && now - *told_end_ < kAgain))
    return std::nullopt;
  if (!told_end_) PrintError("nobody has adopted the run within {:g} s\n", Seconds(setup_.orphan_timeout));
  told_end_ = now;
  return SIGHUP;
}

bool Console::HasGone(std::chrono::milliseconds within)
{
  if (!console_) return false;
  console_->Wait(static_cast<int>(within.count()));
  HearConsole();
  return !console_;
}

void Console::HearConsole()
{
  while (console_)
  {
    auto received = console_->Receive();
    if (!received) return;
    if (received->ended) return Orphan();
    if (!received->message) continue;
    const auto& signal = (*received->message)["signal"];
    if (signal == SIGINT || signal == SIGTERM) signals_.push_back(signal.get<int>());
  }
}

void Console::HearOthers()
{
  while (true)
  {
    FileDescriptor next(accept4(listener_.Get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!next.IsOpen()) break;
    ConsoleLink link(std::move(next));
    if (link.GetPeer().user != geteuid() || others_.size() >= kMostOthers) continue;
    Watch(link.Descriptor());
    others_.push_back(std::move(link));
  }
  for (auto other = others_.begin(); other != others_.end();)
  {
    auto received = other->Receive();
    bool adopted = false;
    if (received && received->message) Answer(*other, *received->message, received->files, adopted);
    if (adopted) console_ = std::move(*other);
    other = adopted || (received && received->ended) ? others_.erase(other) : std::next(other);
  }
}

nlohmann::json Console::State() const
{
  nlohmann::json state{{"experiment", setup_.experiment},
                       {"folder", setup_.folder},
                       {"domain", setup_.domain},
                       {"supervisor", getpid()},
                       {"launcher", console_ ? console_process_ : 0}};
  if (!orphaned_) return state;
  const auto since = Clock::now() - *orphaned_;
  state["orphaned_s"] = Seconds(since);
  state["ends_in_s"] = std::max(0.0, Seconds(setup_.orphan_timeout - since));
  return state;
}

void Console::Answer(ConsoleLink& link, const nlohmann::json& message, std::vector<FileDescriptor>& files,
                     bool& adopted)
{
  nlohmann::json answer = State();
  const auto quiet = message.find("adopt");
  // One that is told to end for want of a console ends.
  adopted = quiet != message.end() && quiet->is_boolean() && files.size() == 2 && !console_ && !told_end_;
  answer["adopted"] = adopted;
  link.Send(answer);
  if (!adopted) return;
  console_process_ = link.GetPeer().process;
  orphaned_.reset();
  Redirect(files[0].Get(), files[1].Get());
  if (changed_) changed_(quiet->get<bool>());
}

void Console::Orphan()
{
  console_.reset();
  orphaned_ = Clock::now();
  const std::string path = setup_.folder + "/orphaned.log";
  FileDescriptor file(OpenOutput(path, O_WRONLY | O_CREAT | O_APPEND));
  if (!file.IsOpen()) file.Reset(open("/dev/null", O_WRONLY | O_CLOEXEC));
  Redirect(file.Get(), file.Get());
  if (changed_) changed_(std::nullopt);
  PrintError(
      "the launcher (process {}) has gone; without it the run goes on for {:g} s; to take it over: swarmanoid "
      "adopt {}\n",
      console_process_, Seconds(setup_.orphan_timeout), setup_.folder);
}

void Console::End(int exit_code)
{
  std::fflush(nullptr);
  if (console_) console_->Send({{"exit_code", exit_code}});
}

}  // namespace swarmanoid
