// Ctrl-C and its kin, of this process and of its console, as something to wait for. While an object lives, SIGINT,
// SIGTERM and SIGHUP do nothing but make the descriptor readable, and writing to a closed pipe is an error instead of a
// death. One at a time, made before any thread.
#pragma once

#include <signal.h>

#include <optional>

#include "common/program/file_descriptor.h"

namespace swarmanoid
{

class Console;

class Interrupts
{
public:
  // `console`: if it is that of another process; outlives the object.
  explicit Interrupts(Console* console = nullptr);
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  int Descriptor() const { return descriptor_.Get(); }
  // The next signal that arrived, if any. Does not wait.
  std::optional<int> Take();
  // Whether standard output has failed since the console has gone: then it goes elsewhere now.
  bool ConsoleHasGone();

private:
  Console* console_;
  FileDescriptor signals_;
  FileDescriptor descriptor_;
  sigset_t before_{};
  struct sigaction pipe_before_
  {
  };
};

}  // namespace swarmanoid
