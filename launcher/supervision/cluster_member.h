// ClusterMember: one process of a cluster for the supervisor: its descriptors, its log and its end.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "common/program/process.h"
#include "launcher/supervision/attribution.h"
#include "launcher/supervision/cluster_plan.h"
#include "launcher/supervision/line_splitter.h"
#include "launcher/supervision/process_log.h"

namespace swarmanoid
{

class ClusterMember
{
public:
  // Starts the process. Throws std::runtime_error if that is impossible. The log of an earlier incarnation is kept.
  ClusterMember(PlannedProcess planned, const ProcessCommand& command, ProcessSpawner& spawner,
                Incarnation incarnation = {});

  // Reads at most `limit` bytes of its standard output, without waiting, and calls on_line for each full line. Only
  // the output of the space server and of visualisers goes there; all others write to their logs.
  using OnLine = std::function<void(std::string_view)>;
  void ReadOutput(const OnLine& on_line, std::size_t limit);
  void ReadErrors();
  // Reads the rest of its errors. Call once, when the process has ended.
  void Collect(ProcessSpawner& spawner);

  void AddToLog(std::string_view line) { log_.Add(line); }

  const PlannedProcess& Planned() const { return planned_; }
  const Incarnation& GetIncarnation() const { return incarnation_; }
  const std::string& Name() const { return planned_.name; }
  const SpawnedProcess& Process() const { return process_; }
  ActivityRecord Record() const { return ReadActivity(process_.activity.get()); }
  const ProcessLog& Log() const { return log_; }
  bool Alive() const { return !end_; }
  const std::optional<ProcessEnd>& End() const { return end_; }
  // Returns whether its standard output has ended.
  bool OutputClosed() const { return !process_.output.IsOpen(); }
  // The last line of its standard output has been passed on, too.
  bool OutputTaken() const { return output_taken_; }

private:
  // Writes the input of the process if the line asks for it; false for all other lines.
  bool Answers(std::string_view line);

  PlannedProcess planned_;
  Incarnation incarnation_;
  std::string input_;
  ProcessLog log_;
  SpawnedProcess process_;
  LineSplitter output_lines_;
  LineSplitter error_lines_;
  std::optional<ProcessEnd> end_;
  bool output_taken_ = false;
};

}  // namespace swarmanoid
