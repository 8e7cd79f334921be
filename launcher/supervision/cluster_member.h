// One process of a cluster as the supervisor sees it: its descriptors, its log, how it ended.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/program/process.h"
#include "launcher/supervision/attribution.h"
#include "launcher/supervision/line_splitter.h"
#include "launcher/supervision/process_log.h"

namespace swarmanoid
{

// A controller that took its process with it.
struct ControllerDeath
{
  std::uint64_t tick = 0;
  std::uint32_t robot = 0;
  bool operator==(const ControllerDeath&) const = default;
};

// What is to be started.
struct MemberPlan
{
  ProcessCommand command;
  std::string host;  // another machine that the command starts it on, or empty
  std::string log_path;
  // Where its standard output goes; standard error always goes to the log.
  enum Output
  {
    kLog,
    kScreen,  // a visualiser's table
    kStatus   // the space server's status lines; other lines go to the log
  };
  Output output = kLog;
  bool visualiser = false;
  // What takes its place when it has died, the given number of times, in a run that has taken so many seconds; empty if
  // nothing can. `deaths`: of controllers in it.
  std::function<ProcessCommand(unsigned incarnation, double taken_s, const std::vector<ControllerDeath>& deaths)>
      replacement;
  // Has what takes its place start on another machine ("" for this one).
  std::function<void(const std::string& host)> place{};
  // Whether the run goes on without the controller of a robot. Empty: without none.
  std::function<bool(std::uint32_t robot)> may_fail{};
};

class ClusterMember
{
public:
  // Starts the process. Throws std::runtime_error if that is impossible.
  // `incarnation`: how many processes have died in its place before; `taken_s`: by the run.
  ClusterMember(const MemberPlan& plan, ProcessSpawner& spawner, unsigned incarnation = 0, double taken_s = 0,
                std::vector<ControllerDeath> deaths = {});

  // Reads what there is, without waiting, and calls on_line for each full line of its standard output unless that goes
  // to the log. At most `limit` bytes.
  using OnLine = std::function<void(std::string_view)>;
  void ReadOutput(const OnLine& on_line, std::size_t limit);
  void ReadErrors();
  // To be called once when the process has ended: reads the rest of its errors.
  void Collect(ProcessSpawner& spawner);

  void AddToLog(std::string_view line) { log_.Add(line); }

  const MemberPlan& Plan() const { return plan_; }
  unsigned Incarnation() const { return incarnation_; }
  // Of controllers in those that had this place before.
  const std::vector<ControllerDeath>& Deaths() const { return deaths_; }
  // If a controller died in it whose run goes on, which has not died there before.
  std::optional<ControllerDeath> NewDeath() const;
  const std::string& Name() const { return plan_.command.name; }
  const SpawnedProcess& Process() const { return process_; }
  ActivityRecord Record() const { return ReadActivity(process_.activity.get()); }
  const ProcessLog& Log() const { return log_; }
  bool Alive() const { return !end_; }
  const std::optional<ProcessEnd>& End() const { return end_; }
  // Nothing more will be read from its standard output.
  bool OutputClosed() const { return !process_.output.IsOpen(); }
  // And on_line has got the last line, too.
  bool OutputTaken() const { return output_taken_; }

private:
  // Whether the line asked for what the process is to read, which it gets then.
  bool Answers(std::string_view line);

  MemberPlan plan_;
  unsigned incarnation_;
  std::vector<ControllerDeath> deaths_;
  ProcessLog log_;
  SpawnedProcess process_;
  LineSplitter output_lines_;
  LineSplitter error_lines_;
  std::optional<ProcessEnd> end_;
  bool output_taken_ = false;
};

}  // namespace swarmanoid
