// A run for renderers and viewers in tests: its messages, and the requests to it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/messages/control_verbs.h"
#include "visualiser/render.h"

namespace swarmanoid::test
{

class FakeControl : public ExperimentControl
{
public:
  void Ask(const ControlOrder& order) override
  {
    const auto* pose = order.Find<std::vector<double>>("pose");
    if (pose != nullptr) place = *pose;
    asked.push_back(pose == nullptr ? TextOf(order) : order.verb + " " + order.Get<std::string>("entity"));
  }

  std::vector<std::string> asked;
  std::vector<double> place;  // pose of the last request that has one: m and degrees
};

class FakeMonitor : public RunMonitor
{
public:
  const RunStatus& Status() override { return status; }
  std::span<const RunNote> Notes() override { return notes; }
  void Watch(std::span<const std::uint32_t> robots) override { watched.assign(robots.begin(), robots.end()); }
  const RobotStatus* Robot(std::uint32_t robot) override { return robot == inside.entity ? &inside : nullptr; }
  std::string RunFolder() override { return run_folder; }

  RunStatus status;
  std::vector<RunNote> notes;
  std::vector<std::uint32_t> watched;
  RobotStatus inside;  // status of one robot
  std::string run_folder;
};

}  // namespace swarmanoid::test
