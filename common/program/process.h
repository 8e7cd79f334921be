// Starts the programs of a cluster and reports their ends. Tests replace ProcessSpawner by scripts or failures. The
// launcher, and visualisers that look back, use it from one thread, which must live as long as the processes that it
// starts.
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

// The program of a process, its arguments and its environment.
struct ProcessCommand
{
  std::string name;                                              // for the user: "engine_worker ground"
  std::vector<std::string> arguments;                            // the program's path first
  std::vector<std::pair<std::string, std::string>> environment;  // added to this process's environment
  std::vector<int> cores;                                        // cores that it may run on; empty: all
  std::string input{};                                           // its standard input; empty: nothing
  int signal_at_our_end = SIGKILL;  // signal that the kernel sends it when this process ends
};

// How a process ended.
struct ProcessEnd
{
  int exit_code = 0;  // if the process ended by itself
  int signal = 0;     // if a signal ended the process

  bool Clean() const { return exit_code == 0 && signal == 0; }
  // Returns "was killed by signal 9 (Killed)", "ended with exit code 3" or "ended".
  std::string Text() const;
};

struct SpawnedProcess
{
  pid_t pid = 0;
  FileDescriptor output;  // its standard output
  FileDescriptor errors;  // its standard error
  FileDescriptor end;     // readable once the process has ended
  // The page of the process, readable also after its death; null if this system has no memory for it. A process on
  // another machine writes nothing there.
  std::shared_ptr<const ActivityPage> activity;
  FileDescriptor input{};  // its standard input, if it gets any
};

class ProcessSpawner
{
public:
  virtual ~ProcessSpawner() = default;
  // Throws std::runtime_error, naming the program, if it cannot be started.
  virtual SpawnedProcess Start(const ProcessCommand& command) = 0;
  // Returns how a process ended. It waits if `end` is not readable yet, and kills processes that the process started
  // and left behind. Call it once.
  virtual ProcessEnd Collect(const SpawnedProcess& process) = 0;
  // Sends a signal to the process and its process group.
  virtual void Signal(const SpawnedProcess& process, int signal) = 0;
};

// Starts real processes. Each leads its own process group and ends with the process that started it. They inherit only
// the descriptors that are given here.
class SystemSpawner : public ProcessSpawner
{
public:
  SpawnedProcess Start(const ProcessCommand& command) override;
  ProcessEnd Collect(const SpawnedProcess& process) override;
  void Signal(const SpawnedProcess& process, int signal) override;
};

// Returns the processor cores that this process may use, ascending.
std::vector<int> AvailableCores();

}  // namespace swarmanoid
