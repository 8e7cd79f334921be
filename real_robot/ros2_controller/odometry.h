// The topic `odom` of a simulated robot. Used by readings.cpp.
#pragma once

#include <memory>

#include "real_robot/ros2_controller/readings.h"

namespace swarmanoid::ros2
{

// The pose of the positioning sensor in the frame "world", else that of the wheels in a frame of their own.
std::unique_ptr<ReadingPublisher> MakeOdometry(const ReadingSetup& setup);

}  // namespace swarmanoid::ros2
