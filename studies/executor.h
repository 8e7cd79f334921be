// Where the runs of a study run: the processes of this machine, other machines, or Slurm's. One thread.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/run_order.h"

namespace swarmanoid
{

// No run can go on there. what() says why, and what cures it.
class RunPlaceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct RunningRun
{
  RunName name;
  std::string where;  // empty: this machine
};

class Executor
{
public:
  Executor() = default;
  virtual ~Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  // Whether it takes another run.
  virtual bool HasRoom() const = 0;
  virtual void Give(RunOrder order) = 0;
  // Whether all runs that it took have their outcome, or were given up because the user interrupted.
  virtual bool IsIdle() const = 0;
  // Waits for some, but not for longer. Throws RunPlaceError.
  virtual std::vector<RunOutcome> Wait(std::chrono::milliseconds longest) = 0;
  // Those that go on now.
  virtual std::vector<RunningRun> Running() const = 0;
  // Runs at a time.
  virtual unsigned Slots() const = 0;
  // What was handed out by Wait is on disk now.
  virtual void Committed() {}
  // Lines for the user since the last call.
  virtual std::vector<std::string> TakeNotes() { return {}; }
};

}  // namespace swarmanoid
