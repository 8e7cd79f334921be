// The processes of this machine that run a study: one for each core, each with one run at a time. They are copies of
// this process, made after it has loaded the plug-ins. They end with it, also if it is killed. One thread.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <deque>
#include <string>
#include <vector>

#include "studies/executors/checked_frame.h"
#include "studies/executors/executor.h"

namespace swarmanoid
{

class RunPool final : public Executor
{
public:
  // `jobs` is the number of processes. `study` must outlive the object.
  RunPool(const Study& study, std::string folder, unsigned jobs);
  ~RunPool() override;

  // Returns whether a process accepts another run. If the next run might exceed the memory, judged by the largest run
  // so far, it waits until others have ended.
  bool HasRoom() const override { return FreeWorker() != workers_.size(); }
  void Give(RunOrder order) override;
  bool IsIdle() const override;
  std::vector<RunOutcome> Wait(std::chrono::milliseconds longest) override { return Wait(longest, -1); }
  // Waits as above, at most until there is data to read from `input`.
  std::vector<RunOutcome> Wait(std::chrono::milliseconds longest, int input);
  std::vector<RunningRun> Running() const override;
  unsigned Slots() const override { return static_cast<unsigned>(workers_.size()); }

private:
  struct Worker
  {
    pid_t process = -1;
    int socket = -1;
    std::deque<RunOrder> orders;  // the first one is in progress
    FrameReader received;
  };

  std::size_t FreeWorker() const;
  void Start(Worker& worker);
  void Send(Worker& worker, const RunOrder& order);
  void TakeOutcomes(Worker& worker, std::vector<RunOutcome>& outcomes);
  void Bury(Worker& worker, std::vector<RunOutcome>& outcomes);

  const Study& study_;
  std::string folder_;
  std::uint64_t memory_bytes_ = 0;  // for all processes
  std::uint64_t peak_bytes_ = 0;    // memory of the largest run so far
  // Short runs are queued behind each other, so that no process waits for this one. Long runs are not queued.
  std::size_t orders_of_worker_ = 1;
  std::vector<Worker> workers_;
};

// Returns the cores that this process may use.
std::vector<int> UsableCores();

}  // namespace swarmanoid
