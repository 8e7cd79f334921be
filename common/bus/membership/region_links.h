// The two ends of the bus connection between a split engine and its region processes. RegionTeamLink is at the engine
// worker, RegionLink at a region. docs/wire.md describes the messages.
//
// All regions do a task together, and each waits for the others several times in it. If one of them is replaced, the
// engine sends the task to all again with all the state that they need (a new epoch). Regions that are in the middle of
// the old task drop it.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/bus/membership/tick_limits.h"
#include "common/bus/membership/worker_session.h"
#include "common/experiment/experiment.h"
#include "common/messages/regions.h"
#include "common/threads/waiting.h"

namespace swarmanoid
{

class RegionTeamLink final : public RegionTeam
{
public:
  // The engine must be split.
  RegionTeamLink(WorkerSession& session, const Experiment& experiment, std::size_t engine, const RegionLimits& limits);
  ~RegionTeamLink() override;

  // Returns the number of regions whose topics are not matched yet.
  unsigned Missing() const;
  // Starts the tasks, once all regions are matched. `role`: the mutex of the role. Work unlocks it while it waits,
  // since threads of the bus may need it.
  void Begin(std::mutex& role);
  // Returns the regions that a task waits for, "region 2 of engine 'ground'"; empty if none.
  std::string Awaited() const;
  void SetTick(std::uint64_t tick) { tick_ = tick; }
  // Tells the regions that the run is over, so that they leave. Waits for regions that are still starting. Throws
  // BusError if the run is given up meanwhile.
  void End();

  unsigned RegionCount() const override { return static_cast<unsigned>(places_.size()); }
  bool IsReady() const override { return role_ != nullptr; }
  void Work(bool all_data, const WriteTasks& write, std::span<std::vector<char>> results,
            const std::function<void()>& meanwhile) override;

private:
  struct Place
  {
    std::string name;
    std::unique_ptr<HotPublisher<RegionTaskMessage>> tasks;
    RegionTaskMessage task;  // the current task
    bool is_here = false;    // the result has arrived
    RegionResultMessage result;
  };

  // Prepares a task for all regions.
  void MakeTask(std::uint32_t epoch, std::uint32_t number, std::span<const ByteWriter> parts);
  // Sends the task to the regions whose results are missing.
  void Send();
  // Waits until all results have arrived, and returns true. Sends the task again at times. Returns false if a region
  // needs a new epoch, or if it takes longer than `most`.
  bool Wait(std::chrono::milliseconds most);
  void Received(const MessageHeader& header, RegionResultMessage& result);

  WorkerSession& session_;
  const std::uint32_t engine_;
  const std::uint32_t first_;  // number of region 0
  std::mutex* role_ = nullptr;
  std::atomic<std::uint64_t> tick_ = 0;
  std::uint32_t epoch_, number_ = 0;  // numbers of the current task
  std::vector<ByteWriter> parts_;
  // Guards the epoch and the number, places_ but for their publishers, is_at_work_ and begins_again_.
  mutable std::mutex mutex_;
  RunCondition changed_;
  std::vector<Place> places_;
  bool is_at_work_ = false;  // there is a task
  bool begins_again_ = false;
  RegionResultMessage arriving_;  // used by the subscription's thread
  HotSubscription<RegionResultMessage> results_;
};

class RegionLink final : public RegionExchange
{
public:
  RegionLink(WorkerSession& session, const Experiment& experiment, std::size_t engine, unsigned region,
             const RegionLimits& limits);
  ~RegionLink() override;

  // Returns how many of the engine worker and the other regions have topics that are not matched yet.
  unsigned Missing() const;
  // Does tasks until the run is over and the engine has left, or until the program calls Close. Failures are reported
  // to the engine.
  void Serve(EngineRegion& region);
  // Returns whether the engine has left or said that the run is over. Other processes may have left already.
  bool IsOver() const { return is_over_; }
  void Close();

  unsigned RegionCount() const override { return regions_; }
  void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) override;

private:
  // The last messages of another region: one with an even number, one with an odd number.
  using Halos = std::array<RegionHaloMessage, 2>;

  void Answer(std::uint32_t epoch, std::uint32_t number, std::span<const char> result, const std::string& error);
  void WriteAnswer();
  void TaskReceived(const MessageHeader& header, RegionTaskMessage& task);
  void HaloReceived(const MessageHeader& header, RegionHaloMessage& halo);
  // The state of the newest task that has come.
  enum class TaskState
  {
    kNone,
    kArrived,
    kInWork,  // or given up, because a region was replaced
    kAnswered
  };
  // The next action of a region between two tasks.
  enum class Next
  {
    kTask,
    kAnswerAgain,
    kHalosAgain,  // another region lacks the last messages
    kAskForAll,   // a task came that needs earlier tasks
    kEnd
  };
  Next WaitForNext();
  bool EngineHasLeft() const;
  void WriteHalo(const RegionHaloMessage& halo, bool lacks_others = false);
  // Repeats the messages of the task that another region may lack.
  void WriteHalosAgain(bool lacks_others);

  WorkerSession& session_;
  const std::uint32_t engine_;
  const std::string engine_name_;
  const std::uint32_t first_;  // number of region 0 of the engine
  const std::uint32_t own_;    // number of this region, from 0
  const unsigned regions_;     // number of regions of the engine
  std::uint64_t tick_ = 0;
  std::atomic<bool> is_over_ = false;
  RegionTaskMessage task_;  // the current task, or the last one
  RegionResultMessage answer_;
  RunTime answered_;
  std::uint32_t exchanges_ = 0;  // number of exchanges in the epoch
  Halos said_;
  // Guards the members down to heard_. The members above belong to the thread that calls Serve.
  std::mutex mutex_;
  RunCondition changed_;
  RegionTaskMessage next_;
  TaskState state_ = TaskState::kNone;
  std::uint64_t next_tick_ = 0;
  std::uint32_t epoch_ = 0, number_ = 0;  // numbers of the newest task that has come
  std::uint32_t missed_epoch_ = 0;        // the epoch that the others began with the predecessor of this process
  bool is_asked_again_ = false;           // the engine asks for the last answer again
  bool is_lost_ = false;                  // a task came that needs earlier tasks
  bool is_halo_missed_ = false;           // another region repeats a message that all have received
  bool is_closed_ = false;
  std::vector<Halos> heard_;  // by region
  RegionTaskMessage arriving_task_;
  RegionHaloMessage arriving_halo_;
  HotPublisher<RegionHaloMessage> halos_out_;
  HotPublisher<RegionResultMessage> results_;
  HotSubscription<RegionHaloMessage> halos_in_;
  HotSubscription<RegionTaskMessage> tasks_;
};

}  // namespace swarmanoid
