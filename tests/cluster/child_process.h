// A program started by a test, with its output in a file; killed at the latest when the object ends.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace swarmanoid
{

// For what comes within moments, on a machine that is busy with much else.
inline constexpr double kGenerous_s = 100;

class ChildProcess
{
public:
  ChildProcess(const std::vector<std::string>& command, const std::string& output_file);
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // The exit code; -1 if the process still runs after that time, 128 + signal if a signal ended it.
  int Wait(double seconds = kGenerous_s);
  void Signal(int signal) const;
  // Stops it, by SIGSTOP, while all its threads sleep: of a paused run it then holds no lock. False if they never do.
  bool StopAsleep() const;
  bool Running() { return Wait(0) < 0; }
  pid_t Id() const { return id_; }
  // What it wrote so far, standard output and error together.
  std::string Output() const;
  bool WaitForOutput(const std::string& text, double seconds = kGenerous_s) const;

private:
  pid_t id_ = -1;
  int exit_code_ = -1;
  std::string output_file_;
};

}  // namespace swarmanoid
