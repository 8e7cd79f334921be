// OfferedWorkers: the workers that run on a machine which somebody offers to a run. Each is started for a process of
// the launcher's machine that stands for it (WorkerRequest), which is told what the worker writes and how it ends, and
// is killed when that process is silent. Only programs of this project are started, with words that were checked one by
// one; network and key are those of the offer. Used by OfferMachine, by one thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "common/bus/cluster_options.h"
#include "common/program/process.h"

namespace swarmanoid
{

// How often a process that stands for a worker asks, after which silence it gives the machine up, and after which the
// machine gives up the worker: later, since the run goes on with another one by then. Times are counted in looks of the
// one who waits, so that a computer that stood still as a whole is not taken for one that has gone.
inline constexpr std::chrono::milliseconds kRequestPeriod{250};
inline constexpr std::chrono::milliseconds kAnswerTime{3000};
inline constexpr std::chrono::milliseconds kSilence{5000};

// Adds up how long nobody was heard.
class SilenceCount
{
public:
  using Clock = std::chrono::steady_clock;

  void Heard() { silent_ = {}; }
  // True once it is longer than `most`.
  bool IsTooLong(Clock::time_point now, std::chrono::milliseconds most)
  {
    if (looked_) silent_ += std::min<Clock::duration>(now - *looked_, kRequestPeriod);
    looked_ = now;
    return silent_ > most;
  }

private:
  std::optional<Clock::time_point> looked_;
  Clock::duration silent_{};
};

class OfferedWorkers
{
public:
  using Clock = SilenceCount::Clock;

  struct Setup
  {
    std::string machine;     // the name of the offer
    std::string experiment;  // its name
    std::string process;     // "host:pid" of this one
    std::string program_folder;
    BusOptions bus;  // of the workers
    std::function<void(const WorkerReportMessage&)> report;
    std::function<void(const std::string&)> say;
  };

  // `spawner` lives as long as the object.
  OfferedWorkers(Setup setup, ProcessSpawner& spawner) : setup_(std::move(setup)), spawner_(spawner) {}
  ~OfferedWorkers() { EndAll(); }
  OfferedWorkers(const OfferedWorkers&) = delete;
  OfferedWorkers& operator=(const OfferedWorkers&) = delete;

  // Requests of another run are not heard.
  void FollowRun(std::uint64_t run) { run_ = run; }
  void Take(const WorkerRequestMessage& request);
  // Reports what there is. To be called all the time.
  void Work(Clock::time_point now);
  bool Any() const { return !workers_.empty(); }
  // Kills them; nobody is told.
  void EndAll();

private:
  struct Worker
  {
    std::string name;  // "controller_host 1"
    SpawnedProcess process{};
    std::optional<ProcessEnd> end{};
    WorkerReportMessage report{};  // the newest
    std::uint32_t taken = 0;
    std::uint32_t signal = 0;  // that it got
    SilenceCount silence{};
  };
  // By the process that stands for it.
  using Workers = std::map<std::string, Worker>;

  // Throws std::runtime_error, or CLI::Error for words that mean nothing.
  Worker Start(const WorkerRequestMessage& request) const;
  void Refuse(const WorkerRequestMessage& request, const std::string& why);
  void MakeReport(Worker& worker);
  Workers::iterator Kill(Workers::iterator worker, const std::string& why);
  static std::string NameOf(const std::string& program, const WorkerSettings& settings);

  Setup setup_;
  ProcessSpawner& spawner_;
  std::uint64_t run_ = 0;
  Workers workers_;
  std::set<std::string> done_;  // processes whose workers have ended
};

}  // namespace swarmanoid
