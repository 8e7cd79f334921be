// StartedRun: a run in a process of its own (`swarmanoid run`) that a page has started, with a page of its own.
// Branches of a run and the editor use it, in one thread, which must live as long.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "common/program/process.h"

namespace swarmanoid
{

class StartedRun
{
public:
  // Starts the run without the visualisations of its experiment. `program`: the command swarmanoid.
  // `what`: the experiment file, or "--branch" with its value, and further options. `folder`: that of the run. Throws
  // std::runtime_error.
  StartedRun(const std::string& program, const std::vector<std::string>& what, std::string folder);
  // Ends the run and waits for it.
  ~StartedRun();
  StartedRun(const StartedRun&) = delete;
  StartedRun& operator=(const StartedRun&) = delete;

  // Looks at the process. Returns false once it has ended.
  bool Look();
  // Asks the run to end after its tick. If it does not within seconds, the next calls of Look kill it.
  void Stop();
  bool IsStopping() const { return stop_ > 0; }
  // Returns the address of the page, with its token; empty until the page is open.
  const std::string& Url() const { return url_; }
  // Returns what the process wrote to its standard error.
  const std::string& Errors() const { return errors_; }
  // Returns the last line of it.
  std::string LastError() const;

private:
  using Clock = std::chrono::steady_clock;

  const std::string folder_;
  SystemSpawner spawner_;
  SpawnedProcess process_;
  std::string url_;
  std::string errors_;
  int stop_ = 0;  // the number of signals that were sent
  Clock::time_point stop_due_;
  bool has_ended_ = false;
};

}  // namespace swarmanoid
