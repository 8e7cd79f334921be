// Starts the programs of a cluster and collects their ends. ProcessSpawner is a seam: tests put scripts or failures
// behind it. The launcher, and visualisers that look back, use it in one thread. That thread must live as long as the
// processes.
#pragma once

#include <csignal>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "common/activity/activity.h"
#include "common/program/file_descriptor.h"

namespace swarmanoid
{

// The command and the environment with which a process is started.
struct ProcessCommand
{
  std::string name{};                                              // for the user: "engine_worker ground"
  std::vector<std::string> arguments{};                            // the program's path first
  std::vector<std::pair<std::string, std::string>> environment{};  // added to this process's environment
  std::vector<int> cores{};                                        // cores that the process may run on; empty: all
  std::string input{};              // the input of the process when it asks for it; empty: nothing
  int signal_at_our_end = SIGKILL;  // signal that the kernel sends the process when this process ends
};

// A process ends by itself or by a signal; one of the numbers tells how.
struct ProcessEnd
{
  int exit_code = 0;  // set if the process ended by itself
  int signal = 0;     // set if a signal ended the process

  bool Clean() const { return exit_code == 0 && signal == 0; }
  // Returns "was killed by signal 9 (Killed)", "ended with exit code 3" or "ended".
  std::string Text() const;
};

struct SpawnedProcess
{
  pid_t pid = 0;
  FileDescriptor output;  // its standard output
  FileDescriptor errors;  // its standard error
  FileDescriptor end;     // readable after the end of the process
  // The page on which the process reports its activity; it can be read after its death. It is null if the system has no
  // memory for it. A process on another machine has no reports.
  std::shared_ptr<const ActivityPage> activity;
  FileDescriptor input{};  // its standard input, if it has input
};

class ProcessSpawner
{
public:
  virtual ~ProcessSpawner() = default;
  // Starts a process. Throws std::runtime_error, which names the program, on failure.
  virtual SpawnedProcess Start(const ProcessCommand& command) = 0;
  // Returns the end of a process. Waits unless its `end` is readable. Kills the processes that it left behind. Call it
  // once.
  virtual ProcessEnd Collect(const SpawnedProcess& process) = 0;
  // Sends a signal to the process and all processes that it started.
  virtual void Signal(const SpawnedProcess& process, int signal) = 0;
};

// Starts real processes. Each leads a process group of its own, and ends with the process that started it. They inherit
// only the descriptors that are given here.
class SystemSpawner : public ProcessSpawner
{
public:
  SpawnedProcess Start(const ProcessCommand& command) override;
  ProcessEnd Collect(const SpawnedProcess& process) override;
  void Signal(const SpawnedProcess& process, int signal) override;
};

// Returns the processor cores that this process may use, in ascending order.
std::vector<int> AvailableCores();

}  // namespace swarmanoid
