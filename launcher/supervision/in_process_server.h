// InProcessServer: the space server of a cluster in this process, so that a user's program can read its own variables
// at each tick. The supervisor starts, stops and hears it like any other process, from a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

#include "common/program/process.h"

namespace swarmanoid
{

// The first process that is started is the server in this process. All others are real processes.
class InProcessServer : public ProcessSpawner
{
public:
  SpawnedProcess Start(const ProcessCommand& command) override;
  ProcessEnd Collect(const SpawnedProcess& process) override;
  void Signal(const SpawnedProcess& process, int signal) override;

  // The work in the thread that calls Run. It gets the command line, the descriptor for status lines, and two flags: to
  // end the run after its tick, and at once. It returns the exit code.
  using Work = std::function<int(const std::vector<std::string>& arguments, int status, const std::atomic<bool>& stop,
                                 const std::atomic<bool>& abandon)>;
  // Waits until the server is started, does its work, and returns when it has ended. Returns at once after Cancel.
  void Run(const Work& work);
  // States that no server will be started any more.
  void Cancel();
  // Returns true if the server was killed but goes on, because users' code does not return. The supervisor treats it as
  // dead.
  bool IsStuck() const;

private:
  bool IsServer(const SpawnedProcess& process) const;

  SystemSpawner others_;
  mutable std::mutex mutex_;  // guards the members below that are not atomic
  std::condition_variable changed_;
  std::optional<ProcessCommand> command_;
  bool cancelled_ = false;
  FileDescriptor status_;
  FileDescriptor end_;  // closed at the end, which the supervisor notices
  int exit_code_ = 0;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> abandon_ = false;
  int kills_ = 0;
  bool stuck_ = false;
};

}  // namespace swarmanoid
