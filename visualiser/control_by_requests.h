// Implements ExperimentControl by text requests, as the control service takes them. The visualiser program and the
// runner of a single process use it.
#pragma once

#include <functional>

#include "common/messages/control_request.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class ControlByRequests : public ExperimentControl
{
public:
  // `send` gets verb, entity and numbers.
  explicit ControlByRequests(std::function<void(const ControlRequestMessage& request)> send) : send_(std::move(send)) {}

  void Pause() override { Ask("pause"); }
  void Resume() override { Ask("resume"); }
  void Step(unsigned ticks) override { Ask("step", "", {static_cast<double>(ticks)}); }
  void SetSpeed(double real_time_factor) override { Ask("speed", "", {real_time_factor}); }
  void MoveEntity(const std::string& id, const Pose& pose) override { AskWithPose("move", id, pose); }
  void AddEntity(const std::string& id, const Pose& pose) override { AskWithPose("add", id, pose); }
  void RemoveEntity(const std::string& id) override { Ask("remove", id); }
  void PressKey(const std::string& key, bool pressed) override { Ask(pressed ? "press" : "release", key); }
  void SelectEntity(const std::string& id) override { Ask(id.empty() ? "deselect" : "select", id); }
  void Stop() override { Ask("stop"); }
  void Reset() override { Ask("reset"); }

private:
  void AskWithPose(const std::string& verb, const std::string& entity, const Pose& pose);
  void Ask(const std::string& verb, const std::string& entity = "", const std::vector<double>& numbers = {});

  std::function<void(const ControlRequestMessage& request)> send_;
};

}  // namespace swarmanoid
