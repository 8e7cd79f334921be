// StatusChannel reports the space server's status to the process that started it. It writes one line for each event to
// a descriptor, with at most ten progress lines a second (server_status.h).
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <string>

#include "common/run/server_status.h"

namespace swarmanoid
{

class StatusChannel
{
public:
  // A negative descriptor has no listener. If the descriptor is standard output, other output goes to standard error
  // from now on. So output of experiment functions is not taken for status lines.
  explicit StatusChannel(int descriptor) : descriptor_(descriptor)
  {
    if (descriptor_ != STDOUT_FILENO) return;
    descriptor_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }

  bool IsOpen() const { return descriptor_ >= 0; }

  // Any thread may call it.
  void Publish(const ServerStatus& status)
  {
    if (!IsOpen()) return;
    const std::string line = ServerStatusLine(status) + "\n";
    // The server notices elsewhere that its launcher has gone.
    if (write(descriptor_, line.data(), line.size()) < 0) descriptor_ = -1;
  }

private:
  std::atomic<int> descriptor_;
};

}  // namespace swarmanoid
