// The commands of a node beside the drive: LEDs, beacon, gripper, turret, laser, magnet, and bytes to send. They come
// on the topics and with the messages that the drivers of real robots publish (real_robot/drivers/ros2).
// ros2_controller makes and uses them, in the thread of the controllers.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
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
  // Passes the command that was taken last to the actuator. Throws DriverError, with the topic, for an invalid one.
  virtual void Apply() = 0;
  // Waits for a command, at most this time (s).
  virtual void Wait(double seconds) = 0;
  // Returns the number of known publishers.
  virtual unsigned Publishers() const = 0;
  // Returns the name of the topic.
  virtual std::string Name() const = 0;
};

// Actuators that `cmd_vel` drives.
inline constexpr std::array<std::string_view, 3> kDrivingActuators{"eyebot_propellers", "footbot_wheels", "wheels"};

// Makes the topics of all other actuators of a robot. With `reliable`, no command is lost.
std::vector<std::unique_ptr<CommandTopic>> MakeCommandTopics(const CCI_Robot& robot, const DriverSetup& setup,
                                                             bool reliable);

}  // namespace swarmanoid::ros2
