// A run that renderers and viewers of tests are shown: what it tells, and what it was asked for.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

#include "visualiser/render.h"

namespace swarmanoid::test
{

class FakeControl : public ExperimentControl
{
public:
  void Pause() override { asked.emplace_back("pause"); }
  void Resume() override { asked.emplace_back("resume"); }
  void Step(unsigned ticks) override { asked.push_back("step " + std::to_string(ticks)); }
  void Reset() override { asked.emplace_back("reset"); }
  void SetSpeed(double factor) override { asked.push_back(fmt::format("speed {:g}", factor)); }
  void MoveEntity(const std::string& id, const Pose& pose) override
  {
    asked.push_back("move " + id);
    place = pose;
  }
  void AddEntity(const std::string& id, const Pose& pose) override
  {
    asked.push_back("add " + id);
    place = pose;
  }
  void RemoveEntity(const std::string& id) override { asked.push_back("remove " + id); }
  void PressKey(const std::string& key, bool pressed) override
  {
    asked.push_back((pressed ? "press " : "release ") + key);
  }
  void SelectEntity(const std::string& id) override { asked.push_back(id.empty() ? "deselect" : "select " + id); }
  void Stop() override { asked.emplace_back("stop"); }

  std::vector<std::string> asked;
  Pose place;  // of the last request that has one
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
  RobotStatus inside;  // of one robot
  std::string run_folder;
};

}  // namespace swarmanoid::test
