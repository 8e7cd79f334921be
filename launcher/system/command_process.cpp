#include "launcher/system/command_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "common/errors/exit_codes.h"
#include "common/program/file_descriptor.h"
#include "common/program/spawn.h"

namespace swarmanoid
{

CommandProcess::CommandProcess(std::vector<std::string> words, const std::string& errors)
{
  const FileDescriptor file(open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!file.IsOpen())
    throw std::runtime_error(fmt::format("cannot start '{}': '{}': {}", words[0], errors, std::strerror(errno)));
  pid_ = Spawn({.words = std::move(words), .errors = file.Get()});
}

bool CommandProcess::Ended()
{
  if (!ended_ && waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
  return ended_;
}

int CommandProcess::Wait()
{
  while (!ended_)
  {
    if (waitpid(pid_, &status_, 0) == pid_)
      ended_ = true;
    else if (errno != EINTR)
      return kExitProcessFailed;
  }
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : static_cast<int>(kExitProcessFailed);
}

std::string FirstLineOf(const std::string& file)
{
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

InterruptsLeftToHelper::InterruptsLeftToHelper() : before_(std::signal(SIGINT, SIG_IGN)) {}
InterruptsLeftToHelper::~InterruptsLeftToHelper() { std::signal(SIGINT, before_); }

}  // namespace swarmanoid
