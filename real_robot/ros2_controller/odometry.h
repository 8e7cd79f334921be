// The topic `odom` of a simulated robot. readings.cpp uses it.
#pragma once

#include <memory>

#include "real_robot/ros2_controller/readings.h"

namespace swarmanoid::ros2
{

// Publishes the pose of the positioning sensor in the frame "world", else that of the wheels in their own frame.
std::unique_ptr<ReadingPublisher> MakeOdometry(const ReadingSetup& setup);

}  // namespace swarmanoid::ros2
