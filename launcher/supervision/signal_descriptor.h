// SignalDescriptor: Ctrl-C and similar signals as an event of a descriptor. While an object lives, SIGINT, SIGTERM and
// SIGHUP only make the descriptor readable, and writing to a closed pipe is an error instead of a death. Only one
// object may exist at a time, made before any thread.
#pragma once

#include <signal.h>

#include <optional>

#include "common/program/file_descriptor.h"

namespace swarmanoid
{

class SignalDescriptor
{
public:
  SignalDescriptor();
  ~SignalDescriptor();
  SignalDescriptor(const SignalDescriptor&) = delete;
  SignalDescriptor& operator=(const SignalDescriptor&) = delete;

  int Descriptor() const { return signals_.Get(); }
  // Returns the next signal that arrived, if any. Does not wait.
  std::optional<int> Take();

private:
  FileDescriptor signals_;
  sigset_t before_{};
  struct sigaction pipe_before_
  {
  };
};

}  // namespace swarmanoid
