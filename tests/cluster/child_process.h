// ChildProcess: a program that a test starts, with its output in a file. It is killed at the latest when the object
// ends.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace swarmanoid
{

// The limit for events that come within moments. It is long, since the machine may be busy with other work.
inline constexpr double kGenerous_s = 100;

class ChildProcess
{
public:
  ChildProcess(const std::vector<std::string>& command, const std::string& output_file);
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Waits and returns the exit code; 128 + signal if a signal ended the process, -1 if it still runs after that time.
  int Wait(double seconds = kGenerous_s);
  void Signal(int signal) const;
  // Stops the process by SIGSTOP while all its threads sleep. If the run is paused, the process then holds no lock.
  // Returns false if the threads never all sleep.
  bool StopAsleep() const;
  bool Running() { return Wait(0) < 0; }
  pid_t Id() const { return id_; }
  // Returns the text written so far, standard output and error together.
  std::string Output() const;
  bool WaitForOutput(const std::string& text, double seconds = kGenerous_s) const;

private:
  pid_t id_ = -1;
  int exit_code_ = -1;
  std::string output_file_;
};

}  // namespace swarmanoid
