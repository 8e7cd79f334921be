#include "studies/host_connection.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "common/activity/failure_report.h"
#include "common/configuration/configuration_tree.h"
#include "common/program/process.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kMostErrors = 4096;
constexpr auto kPatienceAtEnd = 10s;

struct PipeEnds
{
  FileDescriptor read, write;
};

PipeEnds MakeOwnPipe()
{
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

void DoNotWait(const FileDescriptor& file) { fcntl(file.Get(), F_SETFL, fcntl(file.Get(), F_GETFL) | O_NONBLOCK); }

}  // namespace

HostConnection::HostConnection(const std::vector<std::string>& command)
{
  PipeEnds in = MakeOwnPipe(), out = MakeOwnPipe(), err = MakeOwnPipe();
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t own = getpid();
  process_ = fork();
  if (process_ < 0) throw std::runtime_error(fmt::format("cannot start '{}': {}", command[0], std::strerror(errno)));
  if (process_ == 0)
  {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != own) LeaveAtOnce(0);
    setpgid(0, 0);  // Ctrl-C at a terminal is for who supervises
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
    dup2(in.read.Get(), STDIN_FILENO);
    dup2(out.write.Get(), STDOUT_FILENO);
    dup2(err.write.Get(), STDERR_FILENO);
    execvp(words[0], words.data());
    fmt::print(stderr, "cannot start '{}': {}\n", command[0], std::strerror(errno));
    std::fflush(stderr);
    LeaveAtOnce(127);
  }
  in_ = std::move(in.write);
  out_ = std::move(out.read);
  err_ = std::move(err.read);
  for (const FileDescriptor* file : {&in_, &out_, &err_}) DoNotWait(*file);
}

HostConnection::~HostConnection()
{
  in_.Reset();
  const auto start = Clock::now();
  while (process_ > 0 && waitpid(process_, nullptr, WNOHANG) == 0)
  {
    // It may want to say something before it goes.
    ReadSome(out_.Get(), nullptr);
    ReadSome(err_.Get(), nullptr);
    if (Clock::now() - start > kPatienceAtEnd) kill(process_, SIGKILL);
    std::this_thread::sleep_for(5ms);
  }
}

void HostConnection::Send(StudyMessage kind, std::span<const char> content)
{
  ByteWriter message;
  message.Put(kind);
  std::vector<char> bytes = message.Bytes();
  bytes.insert(bytes.end(), content.begin(), content.end());
  const std::vector<char> frame = Framed(bytes);
  unsent_.insert(unsent_.end(), frame.begin(), frame.end());
  said_ = Clock::now();
  WriteSome();
}

bool HostConnection::WriteSome()
{
  if (unsent_.empty() || !in_.IsOpen()) return true;
  const ssize_t written = write(in_.Get(), unsent_.data(), unsent_.size());
  if (written < 0) return errno == EAGAIN || errno == EINTR;
  unsent_.erase(unsent_.begin(), unsent_.begin() + written);
  return true;
}

bool HostConnection::ReadSome(int file, std::string* text)
{
  char bytes[1U << 16U];
  for (;;)
  {
    const ssize_t got = read(file, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno == EAGAIN;
    if (got == 0) return false;
    if (text != nullptr)
    {
      text->append(bytes, static_cast<std::size_t>(got));
      if (text->size() > kMostErrors) text->erase(0, text->size() - kMostErrors);
      continue;
    }
    heard_ = Clock::now();
    frames_.Add({bytes, static_cast<std::size_t>(got)});
  }
}

bool HostConnection::Exchange()
{
  ReadSome(err_.Get(), &errors_);
  const bool writes = WriteSome();
  return ReadSome(out_.Get(), nullptr) && writes;
}

std::string HostConnection::LastWords() const
{
  std::string last;
  std::istringstream lines(errors_ + "\n" + (errors_.empty() ? frames_.Noise() : ""));
  for (std::string line; std::getline(lines, line);)
    if (const std::string words(TrimBlanks(line)); !words.empty()) last = words;
  return last.substr(0, 500);
}

std::string HostConnection::End()
{
  in_.Reset();
  // The end of its output may come a moment before its own.
  const auto start = Clock::now();
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0)
  {
    if (Clock::now() - start > 2s) kill(process_, SIGKILL);
    std::this_thread::sleep_for(5ms);
  }
  process_ = -1;
  ReadSome(err_.Get(), &errors_);
  ProcessEnd end;
  if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  else
    end.exit_code = WEXITSTATUS(status);
  const std::string words = LastWords();
  return "its connection " + end.Text() + (words.empty() ? "" : ": " + words);
}

}  // namespace swarmanoid
