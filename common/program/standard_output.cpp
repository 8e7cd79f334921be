#include "common/program/standard_output.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"

namespace swarmanoid
{

namespace
{

std::atomic<bool> reader_has_gone = false;

}  // namespace

std::optional<std::size_t> TerminalWidth(int descriptor)
{
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

void ReaderOfOutputHasGone() { reader_has_gone = true; }

void OpenStandardFiles()
{
  // `open` takes the lowest free number. Writing to a file that is open for reading is an error, so printed text is not
  // lost silently.
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(number, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDONLY) != number) return;
}

bool OutputIsWritten()
{
  static std::atomic<bool> told = false;
  const bool failed_before = std::ferror(stdout) != 0;
  if (!failed_before) errno = 0;
  if (std::fflush(stdout) == 0 && !failed_before) return true;
  if (errno == EPIPE || reader_has_gone) return true;
  if (told.exchange(true)) return false;
  PrintError("swarmanoid: cannot write the results to standard output{}{}\n", errno == 0 ? "" : ": ",
             errno == 0 ? "" : std::strerror(errno));
  return false;
}

int ExitCodeWithOutput(int code)
{
  return OutputIsWritten() || code != kExitDone ? code : static_cast<int>(kExitProcessFailed);
}

}  // namespace swarmanoid
