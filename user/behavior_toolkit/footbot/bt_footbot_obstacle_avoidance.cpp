#include "footbot/bt_footbot_obstacle_avoidance.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "footbot/bt_footbot_drive.h"

using namespace swarmanoid;

CBTFootbotObstacleAvoidance::CBTFootbotObstacleAvoidance(EVersion version, double speed, double threshold)
    : CCI_Behavior("obstacle avoidance"), version_(version), speed_(speed), threshold_(threshold)
{
}

void CBTFootbotObstacleAvoidance::Step(CCI_FootBotState& cRobotState)
{
  avoiding_ = false;
  if (version_ == VERSION_VECTOR_BASED)
    AvoidByVector(cRobotState);
  else
    AvoidByWeights(cRobotState);
}

void CBTFootbotObstacleAvoidance::AvoidByVector(CCI_FootBotState& cRobotState)
{
  const BTVector obstacle = BTFootbotProximityVector(cRobotState);
  // Obstacles behind the robot need no reaction.
  if (obstacle.length <= threshold_ || std::abs(obstacle.angle) > 2 * kPi / 3) return;
  avoiding_ = true;
  BTFootbotSteer(cRobotState, obstacle.angle + kPi, speed_);
}

void CBTFootbotObstacleAvoidance::AvoidByWeights(CCI_FootBotState& cRobotState)
{
  double readings[CCI_FootBotState::NUM_PROXIMITY_SENSORS];
  cRobotState.GetAllProximitySensorReadings(readings);
  double left = 0;
  double right = 0;
  double largest = 0;
  for (unsigned i = 0; i < CCI_FootBotState::NUM_PROXIMITY_SENSORS; ++i)
  {
    const SinCos direction = SinCosOf(CCI_FootBotState::GetProximitySensorAngle(i));
    if (direction.cos <= -0.5) continue;  // behind
    const double push = readings[i] * (0.5 + direction.cos);
    largest = std::max(largest, readings[i]);
    (direction.sin >= 0 ? left : right) += push;
  }
  if (largest <= threshold_) return;
  avoiding_ = true;
  // An obstacle on the left slows the right wheel.
  const auto wheel = [&](double push) { return speed_ * std::max(-1.0, 1.0 - 2.0 * push); };
  double left_wheel = wheel(right);
  double right_wheel = wheel(left);
  // In front of a wall both sides are equal, so the robot turns to one of them.
  if (left_wheel < 0 && right_wheel < 0) right_wheel = speed_;
  cRobotState.SetFootBotWheelsLinearVelocity(left_wheel, right_wheel);
}
