// Executor: the interface for running the runs of a study, on this machine, on other machines, or by Slurm. One thread.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/runs/run_order.h"

namespace swarmanoid
{

// No run can continue on this executor. what() gives the reason and the cure.
class RunPlaceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct RunningRun
{
  RunName name;
  std::string where;  // the machine; empty: this one
};

class Executor
{
public:
  Executor() = default;
  virtual ~Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  // Returns whether the executor accepts another run.
  virtual bool HasRoom() const = 0;
  // Accepts a run. HasRoom must be true.
  virtual void Give(RunOrder order) = 0;
  // Returns whether all accepted runs have their outcome, or were abandoned because the user interrupted.
  virtual bool IsIdle() const = 0;
  // Waits for outcomes, at most for `longest`. Throws RunPlaceError.
  virtual std::vector<RunOutcome> Wait(std::chrono::milliseconds longest) = 0;
  // Returns the runs in progress.
  virtual std::vector<RunningRun> Running() const = 0;
  // Returns how many runs it executes at a time.
  virtual unsigned Slots() const = 0;
  // Called when the outcomes that Wait returned have been written to disk.
  virtual void Committed() {}
  // Returns the lines for the user since the last call.
  virtual std::vector<std::string> TakeNotes() { return {}; }
};

}  // namespace swarmanoid
