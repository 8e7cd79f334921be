// RunBranches: new runs that pages start from a tick of the shown one (`swarmanoid run --branch`), each with a page of
// its own. They end with this object. web_render uses it in the thread of Draw and Idle, which must live as long.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>

#include "visualiser/started_run.h"

namespace swarmanoid
{

class RunBranches
{
public:
  static constexpr std::size_t kMost = 4;  // at the same time

  struct Answer
  {
    std::uint64_t tick = 0;
    std::string url;    // address of the new run's page; it holds a token
    std::string error;  // why the run has not started; empty: it has
  };
  using Answered = std::function<void(std::uint64_t client, const Answer&)>;

  // `program`: the command swarmanoid.
  RunBranches(std::string program, std::string run_folder, Answered answered);
  ~RunBranches();
  RunBranches(const RunBranches&) = delete;
  RunBranches& operator=(const RunBranches&) = delete;

  const std::string& RunFolder() const { return run_folder_; }
  // Starts a run, in real time. Its folder is below that of the shown run. Answers later.
  void Start(std::uint64_t client, std::uint64_t tick);
  // Answers for runs that have started or failed since the last call.
  void Look();

private:
  struct Branch
  {
    std::uint64_t client;
    std::uint64_t tick;
    std::unique_ptr<StartedRun> run;
    bool is_answered = false;
  };

  // Returns false once the process has ended.
  bool Follow(Branch& branch);

  const std::string program_;
  const std::string run_folder_;
  const Answered answered_;
  std::list<Branch> branches_;
};

}  // namespace swarmanoid
