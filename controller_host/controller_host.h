// The role that runs the controllers of some robots, with their sensors and actuators. A step function over messages.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/activity/failure_report.h"
#include "common/control_interface/ci_controller.h"
#include "common/messages/assignment.h"
#include "common/messages/robot_status.h"
#include "controller_host/device.h"

namespace swarmanoid
{

// A controller failed: what() names the robot, the controller, the tick and the reason.
class ControllerError : public ActivityError
{
public:
  using ActivityError::ActivityError;
};

class ControllerHost
{
public:
  // `space` is the replica of this process; it and `assignment` outlive the host. Loads the controller libraries,
  // creates devices and controllers and calls Init. `threads` share the work of the sensors, and of the controllers
  // that say that they may (StepsInParallel); their number changes no bit of the results. Throws ActivityError, which
  // names the robot or device whose code failed, or ConfigurationError.
  ControllerHost(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t host, unsigned threads = 1);
  ~ControllerHost();

  // Brings the sensors to the tick of the space. `frames`: one for each of layout.frames_from, in that order; empty at
  // tick 0. Tick does so first, unless it was done for this tick.
  void Sense(std::span<const SensorFrame* const> frames);
  // Senses, runs the controllers and commits the actuators. The result is valid until the next call.
  const ControlCommands& Tick(std::span<const SensorFrame* const> frames);
  // What controllers and devices remember. Saving throws ActivityError if a controller cannot be saved (HasState
  // is false).
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);
  // Calls Destroy of every controller, once.
  void Destroy();

  // The inside of a robot after its last control step; false if it is not of this host. Changes nothing: what a
  // controller throws here is shown instead.
  bool Describe(std::uint32_t entity, RobotStatus& status) const;

  const HostLayout& Layout() const { return layout_; }

private:
  struct Batches;
  struct Robot
  {
    std::uint32_t entity = 0;
    Actor actor;
    StreamKey random;  // of its control steps
    std::unique_ptr<CCI_Robot> interface;
    std::unique_ptr<CCI_Controller> controller;
  };

  void UpdateSensors(std::uint64_t tick);
  void UpdateParts(std::uint64_t tick);
  void RunControllers(std::uint64_t tick);
  // The steps of some robots in their order. `activity` hears whose it is.
  template <class ActivityOfThread>
  void ControlSteps(std::span<const std::uint32_t> robots, std::uint64_t tick, ActivityOfThread& activity);
  void StepInTurn(std::span<const std::uint32_t> robots, std::uint64_t tick);
  void StepInParallel(std::uint64_t tick);
  void CommitActuators();
  void StopInactive();
  // What no controller may command: throws ControllerError with robot, device, tick and value.
  void CheckCommands();
  void CheckAttributesOf(const DeviceConfiguration& device, std::span<const std::uint32_t> robots,
                         std::size_t first) const;
  [[noreturn]] void FailCommand(std::uint32_t robot, const DeviceConfiguration& device, double value) const;
  void MakeBatches(const ControllerConfiguration& configuration, const std::vector<std::size_t>& robots);

  const CSwarmanoidSpace& space_;
  const HostLayout& layout_;
  std::vector<Robot> robots_;
  // Numbers in robots_: those whose controllers may step at the same time, and the others.
  std::vector<std::uint32_t> parallel_;
  std::vector<std::uint32_t> in_turn_;
  std::unique_ptr<Batches> batches_;
  std::vector<double> sensor_values_;
  ControlCommands commands_;
  std::optional<std::uint64_t> sensed_tick_;
  bool destroyed_ = false;
};

}  // namespace swarmanoid
