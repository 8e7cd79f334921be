#include "launcher/processes/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "common/activity/exit_codes.h"

namespace swarmanoid
{

Child::Child(std::vector<std::string> words, const std::string& errors)
{
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  // A run blocks and ignores signals of its own.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const int error = posix_spawnp(&pid_, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::runtime_error(fmt::format("cannot start '{}': {}", words[0], std::strerror(error)));
}

bool Child::Ended()
{
  if (!ended_ && waitpid(pid_, &status_, WNOHANG) == pid_) ended_ = true;
  return ended_;
}

int Child::Wait()
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

InterruptsLeftToChild::InterruptsLeftToChild() : before_(std::signal(SIGINT, SIG_IGN)) {}
InterruptsLeftToChild::~InterruptsLeftToChild() { std::signal(SIGINT, before_); }

}  // namespace swarmanoid
