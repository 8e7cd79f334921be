// The two ends between an engine that is split and the processes of its regions, at the bus: RegionTeamLink at the
// engine worker, RegionLink at a region. docs/wire.md tells who says what.
//
// A task is done by all regions together: each waits for the others several times in it. So if one of them is another
// process now, the task is given to all again, with all that they have to know (a new epoch), and those that were in
// the middle of it drop it.
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
  // Of an engine that is split.
  RegionTeamLink(WorkerSession& session, const Experiment& experiment, std::size_t engine, const RegionLimits& limits);
  ~RegionTeamLink() override;

  // Regions whose topics have not been met yet.
  unsigned Missing() const;
  // All have been met: they do the tasks from now on. `role`: the mutex of the role, which Work unlocks while it waits,
  // since threads of the bus may need it.
  void Begin(std::mutex& role);
  // The regions that a task waits for: "region 2 of engine 'ground'"; empty if none.
  std::string Awaited() const;
  void SetTick(std::uint64_t tick) { tick_ = tick; }
  // The run is over: regions are told, so that they leave; those that are still on their way are waited for. Throws
  // BusError if the run is given up meanwhile.
  void End();

  unsigned RegionCount() const override { return static_cast<unsigned>(places_.size()); }
  bool IsReady() const override { return role_ != nullptr; }
  void Work(bool anew, const WriteTasks& write, std::span<std::vector<char>> results) override;

private:
  struct Place
  {
    std::string name;
    std::unique_ptr<HotPublisher<RegionTaskMessage>> tasks;
    RegionTaskMessage task;  // the present one
    bool is_here = false;    // its result
    RegionResultMessage result;
  };

  // A task of all regions.
  void MakeTask(std::uint32_t epoch, std::uint32_t number, std::span<const ByteWriter> parts);
  // To those whose results are not here.
  void Send();
  // Sends the task until all results are here, or a region has to be told all: true for the former. False also if it
  // takes longer than `most`.
  bool SendAndWait(std::chrono::milliseconds most);
  void Received(const MessageHeader& header, RegionResultMessage& result);

  WorkerSession& session_;
  const std::uint32_t engine_;
  const std::uint32_t first_;  // number of region 0
  std::mutex* role_ = nullptr;
  std::atomic<std::uint64_t> tick_ = 0;
  std::uint32_t epoch_, number_ = 0;  // of the present task
  std::vector<ByteWriter> parts_;
  mutable std::mutex mutex_;
  RunCondition changed_;
  std::vector<Place> places_;
  bool begins_again_ = false;
  RegionResultMessage arriving_;  // of the subscription's thread
  HotSubscription<RegionResultMessage> results_;
};

class RegionLink final : public RegionExchange
{
public:
  RegionLink(WorkerSession& session, const Experiment& experiment, std::size_t engine, unsigned region,
             const RegionLimits& limits);
  ~RegionLink() override;

  // Of the engine worker and the other regions, those whose topics have not been met yet.
  unsigned Missing() const;
  // Does tasks until the run is over and the engine has left, or the program asks for the end (Close). What fails is
  // told to the engine.
  void Serve(EngineRegion& region);
  // The engine has said that the run is over, or left. Others may have left already.
  bool IsOver() const { return is_over_; }
  void Close();

  unsigned RegionCount() const override { return regions_; }
  void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) override;

private:
  // What another region said last in an even or odd message.
  using Halos = std::array<RegionHaloMessage, 2>;

  void Answer(std::uint32_t epoch, std::uint32_t number, std::span<const char> result, const std::string& error);
  void WriteAnswer();
  void TaskReceived(const MessageHeader& header, RegionTaskMessage& task);
  void HaloReceived(const MessageHeader& header, RegionHaloMessage& halo);
  // What a region does next, between two tasks.
  enum class Next
  {
    kTask,
    kAnswerAgain,
    kHalosAgain,  // another one has not got the last ones
    kAskForAll,   // a task came that builds upon others
    kEnd
  };
  Next WaitForNext();
  bool EngineHasLeft() const;
  void WriteHalo(const RegionHaloMessage& halo, bool lacks_others = false);
  // Those of the task that another one may lack.
  void WriteHalosAgain(bool lacks_others);

  WorkerSession& session_;
  const std::uint32_t engine_;
  const std::string engine_name_;
  const std::uint32_t first_;  // number of region 0 of the engine
  const std::uint32_t own_;    // of this one, from 0
  const unsigned regions_;     // of the engine
  std::uint64_t tick_ = 0;
  std::atomic<bool> is_over_ = false;
  RegionTaskMessage task_;  // in work, or done last
  RegionResultMessage answer_;
  RunTime answered_;
  std::uint32_t exchanges_ = 0;  // in the epoch
  Halos said_;
  std::mutex mutex_;
  RunCondition changed_;
  RegionTaskMessage next_;
  bool has_next_ = false;
  std::uint64_t next_tick_ = 0;
  std::uint32_t epoch_ = 0, number_ = 0;  // of the newest task that has come
  std::uint32_t missed_epoch_ = 0;        // that the others began with the process before this one
  bool is_done_ = false;                  // that one, and answered
  bool is_asked_again_ = false;           // for the last answer
  bool is_lost_ = false;                  // a task came that builds upon others
  bool is_halo_missed_ = false;           // somebody says again what all have heard
  bool is_closed_ = false;
  std::vector<Halos> heard_;  // of each region
  RegionTaskMessage arriving_task_;
  RegionHaloMessage arriving_halo_;
  HotPublisher<RegionHaloMessage> halos_out_;
  HotPublisher<RegionResultMessage> results_;
  HotSubscription<RegionHaloMessage> halos_in_;
  HotSubscription<RegionTaskMessage> tasks_;
};

}  // namespace swarmanoid
