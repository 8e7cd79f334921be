// The commands of a node beside driving: LEDs, beacon, gripper, turret, laser, magnet, and bytes to send. They use the
// topics and messages that the drivers of real robots publish (real_robot/drivers/ros2). ros2_controller makes and uses
// them in the thread of the controllers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/control_interface/ci_robot.h"
#include "real_robot/drivers/ros2/ros2_messages.h"

namespace swarmanoid::ros2
{

class CommandTopic
{
public:
  virtual ~CommandTopic() = default;
  // Takes the next command, oldest first; returns false if none exists.
  virtual bool Take() = 0;
  // Passes the command that was taken last to the actuator. Throws DriverError, with the topic, if it is invalid.
  virtual void Apply() = 0;
  // Waits for a command, at most this time (s).
  virtual void Wait(double seconds) = 0;
  // Returns the number of known publishers.
  virtual unsigned Publishers() const = 0;
  // Returns the name of the topic.
  virtual std::string Name() const = 0;
};

// Returns the types of actuators that have topics, in ascending order.
std::vector<std::string> CommandedActuators();
// Makes the topics of all actuators of a robot that have one. `reliable`: no command is lost.
std::vector<std::unique_ptr<CommandTopic>> MakeCommandTopics(const CCI_Robot& robot, const DriverSetup& setup,
                                                             bool reliable);

}  // namespace swarmanoid::ros2
