// StatusChannel: how the space server tells whoever started it what it is doing: one line an event on a descriptor, at
// most ten progress lines a second (server_status.h).
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
  // Negative: nobody listens. If the descriptor is standard output, what anybody prints goes to standard error from
  // here on: no word of experiment functions is taken for one of the server.
  explicit StatusChannel(int descriptor) : descriptor_(descriptor)
  {
    if (descriptor_ != STDOUT_FILENO) return;
    descriptor_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    dup2(STDERR_FILENO, STDOUT_FILENO);
  }

  bool IsOpen() const { return descriptor_ >= 0; }

  // From any thread.
  void Publish(const ServerStatus& status)
  {
    if (!IsOpen()) return;
    const std::string line = ServerStatusLine(status) + "\n";
    // A launcher that has gone is noticed elsewhere.
    if (write(descriptor_, line.data(), line.size()) < 0) descriptor_ = -1;
  }

private:
  std::atomic<int> descriptor_;
};

}  // namespace swarmanoid
