// The readings of a simulated robot as the messages that a real one publishes: the other end of the drivers
// (real_robot/drivers/ros2). Made and used by ros2_controller, in the thread of the controllers.
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
  // Publishes the readings of the sensor in this control step.
  virtual void Publish(const Header& header) = 0;
  // Returns the number of known listeners.
  virtual unsigned Listeners() const = 0;
};

struct ReadingSetup
{
  const CCI_Robot* robot = nullptr;
  DriverSetup driver;
  double range_m = 0;                     // of the proximity sensors
  const WheelOdometry* wheels = nullptr;  // of robots with wheels
  bool awaited = false;                   // a node answers each reading, and the run waits for it
};

// A topic of readings. A listener that waits for each of them misses none.
template <class Message>
class ReadingTopic : public Publisher<Message>
{
public:
  ReadingTopic(const ReadingSetup& setup, const std::string& topic)
      : Publisher<Message>(setup.driver, topic, setup.awaited ? Writer::Keeps::kAwaited : Writer::Keeps::kRecent)
  {
  }
};

// Makes the publishers for all sensors of a robot, and behind them its odometry, if it has wheels or `positioning`,
// which has no topic of its own. Throws DriverError.
std::vector<std::unique_ptr<ReadingPublisher>> MakeReadings(const ReadingSetup& setup);

}  // namespace swarmanoid::ros2
