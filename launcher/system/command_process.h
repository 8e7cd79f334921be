// CommandProcess: a child process that does one task and ends, such as a run of `swarmanoid` for `demo` and `doctor`.
// It reads and prints nothing; its errors go to a file.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace swarmanoid
{

class CommandProcess
{
public:
  // `words`: the program first, as a path or a name on the PATH. Throws std::runtime_error if it cannot be started.
  CommandProcess(std::vector<std::string> words, const std::string& errors);
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;

  bool Ended();
  // Waits and returns the exit code. For a child that a signal ended, it is that of a failed process.
  int Wait();

private:
  pid_t pid_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

// Returns the first line of a file, or an empty text.
std::string FirstLineOf(const std::string& file);

// While the object lives, only the children react to Ctrl-C.
class InterruptsLeftToHelper
{
public:
  InterruptsLeftToHelper();
  ~InterruptsLeftToHelper();
  InterruptsLeftToHelper(const InterruptsLeftToHelper&) = delete;
  InterruptsLeftToHelper& operator=(const InterruptsLeftToHelper&) = delete;

private:
  void (*before_)(int);
};

}  // namespace swarmanoid
