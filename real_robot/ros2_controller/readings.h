// Publishes the readings of a simulated robot as the messages of a real one: the counterpart of the drivers
// (real_robot/drivers/ros2). ros2_controller makes and uses it in the thread of the controllers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/control_interface/ci_robot.h"
#include "real_robot/drivers/ros2/ros2_messages.h"
#include "real_robot/ros2_controller/wheel_odometry.h"

namespace swarmanoid::ros2
{

using Header = std_msgs::msg::dds_::Header_;

class ReadingPublisher
{
public:
  virtual ~ReadingPublisher() = default;
  // Publishes the reading of the sensor in this control step.
  virtual void Publish(const Header& header) = 0;
  // Returns the number of known listeners.
  virtual unsigned Listeners() const = 0;
};

struct ReadingSetup
{
  const CCI_Robot* robot = nullptr;
  DriverSetup driver;
  double range_m = 0;                     // range of the proximity sensors
  const WheelOdometry* wheels = nullptr;  // set for robots with wheels
  bool awaited = false;                   // a node answers each reading, and the run waits for it
};

// A topic of readings. A subscriber that waits for each reading misses none.
template <class Message>
class ReadingTopic : public Publisher<Message>
{
public:
  ReadingTopic(const ReadingSetup& setup, const std::string& topic)
      : Publisher<Message>(setup.driver, topic, setup.awaited ? Writer::Keeps::kAwaited : Writer::Keeps::kRecent)
  {
  }
};

// Returns the types of sensors that have topics, in ascending order. `positioning` has no topic of its own: it is part
// of `odom`.
std::vector<std::string> PublishedSensors();
// Makes the topics of all sensors of a robot that have one. If the robot has wheels or `positioning`, its odometry
// follows them. Throws DriverError.
std::vector<std::unique_ptr<ReadingPublisher>> MakeReadings(const ReadingSetup& setup);

}  // namespace swarmanoid::ros2
