// Starting the programs of a cluster and hearing of their ends. ProcessSpawner is a seam: tests put scripts or failures
// behind it. Used by the launcher and by visualisers that look back: by one thread, which lives as long as the
// processes that it starts.
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
  std::vector<std::pair<std::string, std::string>> environment{};  // added to ours
  std::vector<int> cores{};                                        // that it may run on; empty: all
  std::string input{};                                             // what it gets to read when it asks; empty: nothing
  int signal_at_our_end = SIGKILL;                                 // that the kernel sends it when this process ends
};

// How a process ended.
struct ProcessEnd
{
  int exit_code = 0;  // if it ended by itself
  int signal = 0;     // if a signal ended it

  bool Clean() const { return exit_code == 0 && signal == 0; }
  // "was killed by signal 9 (Killed)", "ended with exit code 3", "ended".
  std::string Text() const;
};

struct SpawnedProcess
{
  pid_t pid = 0;
  FileDescriptor output;  // its standard output
  FileDescriptor errors;  // its standard error
  FileDescriptor end;     // readable once it has ended
  // The page on which the process reports its activity; it can be read after its death. It is null if the system has no
  // memory for it. A process on another machine has no reports.
  std::shared_ptr<const ActivityPage> activity;
  FileDescriptor input{};  // its standard input, if there is something for it to read
};

class ProcessSpawner
{
public:
  virtual ~ProcessSpawner() = default;
  // Throws std::runtime_error, naming the program, if it cannot be started.
  virtual SpawnedProcess Start(const ProcessCommand& command) = 0;
  // Returns the end of a process. Waits unless its `end` is readable. Kills the processes that it left behind. Call it
  // once.
  virtual ProcessEnd Collect(const SpawnedProcess& process) = 0;
  // Sends a signal to the process and all that it started.
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

// The processor cores that this process may use, ascending.
std::vector<int> AvailableCores();

}  // namespace swarmanoid
