// The role that runs the controllers of some robots, with their sensors and actuators. A step function over messages.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/control_interface/ci_controller.h"
#include "common/space/assignment.h"
#include "common/space/robot_status.h"
#include "controller_host/device.h"

namespace swarmanoid
{

// A controller failed: what() names the robot, the tick and the reason.
class ControllerError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class ControllerHost
{
public:
  // `space` is the replica of this process; it and `assignment` outlive the host. Loads the controller libraries,
  // creates devices and controllers and calls Init. Throws ControllerError or ConfigurationError.
  ControllerHost(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t host);
  ~ControllerHost();

  // Senses, runs the controllers and commits the actuators at the tick of the space. `frames`: one for each of
  // layout.frames_from, in that order; empty at tick 0. The result is valid until the next call.
  const ControlCommands& Step(std::span<const SensorFrame* const> frames);
  // What controllers and devices remember. Saving throws ControllerError where a controller cannot be saved (HasState
  // is false).
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);
  // Calls Destroy of every controller, once.
  void Destroy();

  // The inside of a robot after its last control step; false where it is not of this host. Changes nothing: what a
  // controller throws here is shown instead.
  bool Describe(std::uint32_t entity, RobotStatus& status) const;

  const HostLayout& Layout() const { return layout_; }
  // The robot whose control step runs now, empty between steps; readable from another thread to report a stuck
  // controller.
  const char* RunningRobot() const { return running_robot_; }

private:
  struct Batches;
  struct Robot
  {
    std::uint32_t entity = 0;
    StreamKey random;  // of its control steps
    std::unique_ptr<CCI_Robot> interface;
    std::unique_ptr<CCI_Controller> controller;
  };

  void StillAbsent();
  void MakeBatches(const ControllerConfiguration& configuration, const std::vector<std::size_t>& robots);

  const CSwarmanoidSpace& space_;
  const HostLayout& layout_;
  std::vector<Robot> robots_;
  std::unique_ptr<Batches> batches_;
  std::vector<double> sensor_values_;
  ControlCommands commands_;
  const char* volatile running_robot_ = "";
  bool destroyed_ = false;
};

}  // namespace swarmanoid
