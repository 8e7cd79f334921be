// A study serves many machines from one thread, so no call may wait. Pipes do not block: what cannot be written stays
// in `unsent_`, and what comes is collected until a frame is complete. Standard error is kept up to 4,096 bytes, since
// its last line is often the only reason why a connection by ssh has ended. The process leads a group of its own, so
// that Ctrl+C reaches only the study, which ends its machines in order.
#include "studies/executors/machine_connection.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <sstream>
#include <thread>

#include "common/configuration/configuration_tree.h"
#include "common/program/process.h"
#include "common/program/spawn.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kMostErrors = 4096;
constexpr auto kPatienceAtEnd = 10s;

}  // namespace

MachineConnection::MachineConnection(const std::vector<std::string>& command)
{
  Pipe in = MakePipe(), out = MakePipe(), err = MakePipe();
  fcntl(in.read.Get(), F_SETFL, 0);
  // Ctrl-C at a terminal must reach only the supervising process.
  process_ = Spawn({.words = command,
                    .input = in.read.Get(),
                    .output = out.write.Get(),
                    .errors = err.write.Get(),
                    .leads_group = true,
                    .signal_at_our_end = SIGKILL});
  in_ = std::move(in.write);
  out_ = std::move(out.read);
  err_ = std::move(err.read);
  fcntl(in_.Get(), F_SETFL, O_NONBLOCK);
}

MachineConnection::~MachineConnection()
{
  in_.Reset();
  const auto start = Clock::now();
  while (process_ > 0 && waitpid(process_, nullptr, WNOHANG) == 0)
  {
    // The other side may send a last message before it ends.
    ReadSome(out_.Get(), nullptr);
    ReadSome(err_.Get(), nullptr);
    if (Clock::now() - start > kPatienceAtEnd) kill(process_, SIGKILL);
    std::this_thread::sleep_for(5ms);
  }
}

void MachineConnection::Send(StudyMessage kind, std::span<const char> content)
{
  const std::vector<char> frame = FramedMessage(kind, content);
  unsent_.insert(unsent_.end(), frame.begin(), frame.end());
  said_ = Clock::now();
  WriteSome();
}

bool MachineConnection::WriteSome()
{
  if (unsent_.empty() || !in_.IsOpen()) return true;
  const ssize_t written = write(in_.Get(), unsent_.data(), unsent_.size());
  if (written < 0) return errno == EAGAIN || errno == EINTR;
  unsent_.erase(unsent_.begin(), unsent_.begin() + written);
  return true;
}

bool MachineConnection::ReadSome(int file, std::string* text)
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

bool MachineConnection::Exchange()
{
  ReadSome(err_.Get(), &errors_);
  const bool writes = WriteSome();
  return ReadSome(out_.Get(), nullptr) && writes;
}

std::string MachineConnection::LastWords() const
{
  std::string last;
  std::istringstream lines(errors_ + "\n" + (errors_.empty() ? frames_.Noise() : ""));
  for (std::string line; std::getline(lines, line);)
    if (const std::string words(TrimBlanks(line)); !words.empty()) last = words;
  return last.substr(0, 500);
}

std::string MachineConnection::End()
{
  in_.Reset();
  // The pipe may close a moment before the process ends.
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
