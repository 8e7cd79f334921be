// The role that runs the controllers of some robots, with their sensors and actuators. A step function over messages.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/activity/failure_report.h"
#include "common/control_interface/ci_batch_controller.h"
#include "common/limits/step_timeout.h"
#include "common/messages/assignment.h"
#include "common/threads/worker_pool.h"
#include "controller_host/device.h"
#include "idl/robot_status.h"

namespace swarmanoid
{

class BatteryReports;
class DeviceFaults;

// A controller failed: what() names the robot, the controller, the tick and the reason.
class ControllerError : public ActivityError
{
public:
  using ActivityError::ActivityError;
};

class ControllerHost
{
public:
  // Loads the controller libraries, creates devices and controllers, and calls Init. `space` is the replica of this
  // process; it and `assignment` outlive the host. The threads of `pool`, if it is given, share the work of the sensors
  // and of controllers that allow it (StepsInParallel). At most SharedActivity::kMostThreads take part, and their
  // number changes no bit of the results. Throws ActivityError, which names the robot or device whose code failed, or
  // ConfigurationError.
  ControllerHost(const CSwarmanoidSpace& space, const Assignment& assignment, std::size_t host,
                 WorkerPool* pool = nullptr);
  ~ControllerHost();

  // Returns the distance (m, in the plane, between origins) beyond which entities may be missing from the space without
  // a change for the devices. It is infinite if a device may ask for any entity.
  double Reach() const;

  // Brings the sensors to the tick of the space. `frames`: one for each of layout.frames_from, in that order; empty at
  // tick 0. Tick does so first, unless it was done for this tick.
  void Sense(std::span<const SensorFrame* const> frames);
  // Senses, runs the controllers and commits the actuators. The result, the commands that act at this tick, is valid
  // until the next call.
  const ControlCommands& Tick(std::span<const SensorFrame* const> frames);
  // Returns the commands that act at a tick, after its Tick.
  const ControlCommands& Commands() const { return ahead_ == 0 ? commands_ : due_; }
  // Returns the commands of the last control steps, which act framework.ahead ticks later.
  const ControlCommands& NewestCommands() const { return commands_; }
  // Returns the commands that act at the tick of the space, before its Tick, if commands act a tick late. Otherwise it
  // returns nullptr.
  const ControlCommands* Due();
  // Sets the faults recorded for ticks to come. The same controllers fail in them, controllers that died are not
  // called, and no time is measured before `until`.
  void Know(RecordedFaults known);
  // The tick to come was done before, with these faults and no others.
  void KnowTick(std::uint64_t tick, const ControllerFaults& faults);
  // Sets the advice for users if a controller kills this process although on_failure asks for something else. The text
  // must be a literal.
  void SetCureOfDeath(const char* cure) { cure_of_death_ = cure; }
  // Saves the state of controllers and devices. Throws ActivityError if a controller cannot be saved (HasState is
  // false).
  void SaveState(ByteWriter& state) const;
  void LoadState(ByteReader& state);
  // Calls Destroy of every controller, once.
  void Destroy();

  // Fills in the inside of a robot after its last control step. Returns false if the robot is not of this host. Changes
  // nothing: an exception of a controller is shown instead.
  bool Describe(std::uint32_t entity, RobotStatus& status) const;

  const HostLayout& Layout() const { return layout_; }

private:
  struct Batches;
  // The guard of a robot whose controller may fail or has a time budget.
  struct Guard
  {
    const ControllerConfiguration* configuration = nullptr;
    bool stopped = false;
    FaultKind kind = FaultKind::kThrew;  // of the last fault
    std::uint64_t failed_at = 0;
    std::uint32_t restarts = 0;  // of late
    std::string state{};         // that it last had at a canonical tick, if it is started again from it
  };
  struct Robot
  {
    std::uint32_t entity = 0;
    Actor actor;
    std::unique_ptr<CCI_Robot> interface;
    std::unique_ptr<CCI_Controller> controller;
    std::unique_ptr<Guard> guard;  // none: what it throws ends the run, and it may take its time

    bool IsStopped() const { return guard != nullptr && guard->stopped; }
  };
  // Robots whose control steps are made by one call.
  struct BatchOfRobots
  {
    std::vector<std::uint32_t> robots;  // positions in robots_
    CCI_Batch batch{};                  // those of the last tick
  };
  // The commands for robots that are stopped.
  struct Silence
  {
    std::vector<std::uint32_t> robots;                          // entities, ascending
    std::vector<std::uint32_t> slots;                           // of what shows of them: 0
    std::vector<std::pair<std::size_t, std::size_t>> commands;  // first and behind the last in ControlCommands::values
  };

  void MakeBatteries();
  void MakeFaults();
  void AddFault(const FaultConfiguration& fault, std::span<const std::uint32_t> entities);
  void LogBatteries() const;
  // Lists the robots whose controllers are called: all that are not switched off by a fault.
  void ListSteps();
  void UpdateSensors(std::uint64_t tick);
  void UpdateParts(std::uint64_t tick);
  void RunControllers(std::uint64_t tick);
  // Runs the steps of some robots in their order. `activity` is told which robot it is.
  template <class ActivityOfThread>
  void ControlSteps(std::span<const std::uint32_t> robots, std::uint64_t tick, ActivityOfThread& activity);
  void StepInTurn(std::span<const std::uint32_t> robots, std::uint64_t tick);
  void StepInParallel(std::uint64_t tick);
  // Runs the steps of controllers that derive from CCI_BatchController, in threads if they allow it.
  void StepBatches(std::uint64_t tick);
  template <class ActivityOfThread>
  void StepBatch(BatchOfRobots& robots, std::uint64_t tick, ActivityOfThread& activity);
  void StepGuarded(std::uint64_t tick);
  void TryStep(Robot& robot, std::uint64_t tick);
  // Returns false if it took more than its time budget.
  bool StepInTime(Robot& robot, std::uint64_t tick);
  std::optional<FaultKind> Known(std::uint64_t tick, std::uint32_t robot) const;
  // `text` goes to the log of this process, and `thrown`, what an exception said, to the events of the run.
  void TakeFault(Robot& robot, FaultKind kind, std::uint64_t tick, const std::string& text, const std::string& thrown);
  // Throws ActivityError if the controller cannot begin again.
  void Restart(Robot& robot, std::uint64_t tick);
  // Saves the state of a robot's devices before its step, and restores it if the step failed.
  void SaveDevices(const Robot& robot);
  void LoadDevices(const Robot& robot);
  // Calls use(batch, number of the robot in it) with each sensor and actuator of a robot.
  template <class Do>
  void ForEachDevice(const Robot& robot, Do use);
  // Calls use(first, behind) with each place of the robot in ControlCommands::values.
  template <class Do>
  void ForEachCommand(std::uint32_t entity, Do use) const;
  std::vector<AttributeChanges> ChangesByRobot() const;
  void SaveCommands(std::uint32_t entity, const AttributeChanges& changes, ByteWriter& bytes) const;
  void LoadCommands(std::uint32_t entity, ByteReader& bytes);
  void Stop(const Robot& robot);
  void SilenceStopped();
  void SaveLastStates(std::uint64_t tick);
  void DescribeController(const Robot& robot, RobotStatus& status) const;
  void CommitActuators();
  // Throws ControllerError with robot, device, tick and value if a command is not allowed.
  void CheckCommands();
  void CheckAttributesOf(const DeviceConfiguration& device, std::span<const std::uint32_t> robots,
                         std::size_t first) const;
  [[noreturn]] void FailCommand(std::uint32_t robot, const DeviceConfiguration& device, double value) const;
  void MakeBatches(const ControllerConfiguration& configuration, const std::vector<std::size_t>& robots);

  const CSwarmanoidSpace& space_;
  const HostLayout& layout_;
  std::vector<Robot> robots_;
  // The robots of each entry of <controllers> whose steps are made by one call, divided among threads.
  std::vector<std::vector<BatchOfRobots>> batches_of_robots_;
  // The numbers are positions in robots_: controllers that may step at the same time, the others, and those with a
  // guard.
  std::vector<std::uint32_t> parallel_;
  std::vector<std::uint32_t> in_turn_;
  std::vector<std::uint32_t> guarded_;
  Silence silence_;
  RecordedFaults known_;  // its faults by tick and robot
  std::optional<std::uint64_t> known_tick_;
  ControllerFaults faults_of_tick_;
  const char* cure_of_death_ = "";
  std::unique_ptr<Batches> batches_;
  std::unique_ptr<BatteryReports> battery_reports_;  // null without an energy_battery
  FaultConfiguration empty_battery_;                 // switches its robots off
  std::unique_ptr<DeviceFaults> device_faults_;      // null if nothing can fail
  std::vector<double> sensor_values_;
  const std::uint32_t ahead_;  // framework.ahead
  std::uint64_t stepped_tick_ = 0;
  ByteWriter before_step_;    // SaveDevices
  ControlCommands commands_;  // of the control steps of that tick
  ControlCommands due_;       // that act in it, where these are of the steps before
  std::optional<std::uint64_t> due_tick_;
  std::optional<std::uint64_t> sensed_tick_;
  bool destroyed_ = false;
};

// Ends the process if a controller with a time budget does not come back: what has not ended cannot be measured. Null
// if no controller of the host has one.
std::unique_ptr<StepTimeout> WatchTimeBudgets(const Experiment& experiment, const HostLayout& layout);

}  // namespace swarmanoid
