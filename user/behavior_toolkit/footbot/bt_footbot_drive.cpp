#include "footbot/bt_footbot_drive.h"

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"

using namespace swarmanoid;

void BTFootbotSteer(CCI_FootBotState& cRobotState, double direction, double speed)
{
  const double angle = WrapAngle(direction);
  // Straight ahead both wheels run at full speed. From 60 degrees on, the inner wheel runs backwards.
  const double slow = speed * std::max(-1.0, 1.0 - 2.0 * std::abs(angle) / (kPi / 3));
  if (angle > 0)
    cRobotState.SetFootBotWheelsLinearVelocity(slow, speed);
  else
    cRobotState.SetFootBotWheelsLinearVelocity(speed, slow);
}

double BTFootbotTurn(CCI_FootBotState& cRobotState, double angle, double speed)
{
  const double rate = 2 * speed / CCI_FootBotWheelsActuator::INTERWHEEL_DISTANCE_M;
  const double most = rate * cRobotState.GetTickSeconds();
  const double turned = std::clamp(angle, -most, most);
  const double wheel = speed * turned / most;
  cRobotState.SetFootBotWheelsLinearVelocity(-wheel, wheel);
  return turned;
}

BTVector BTFootbotProximityVector(const CCI_FootBotState& cRobotState)
{
  double readings[CCI_FootBotState::NUM_PROXIMITY_SENSORS];
  cRobotState.GetAllProximitySensorReadings(readings);
  double x = 0;
  double y = 0;
  for (unsigned i = 0; i < CCI_FootBotState::NUM_PROXIMITY_SENSORS; ++i)
  {
    if (readings[i] == 0) continue;
    const SinCos direction = SinCosOf(CCI_FootBotState::GetProximitySensorAngle(i));
    x += readings[i] * direction.cos;
    y += readings[i] * direction.sin;
  }
  return {Atan2(y, x), std::sqrt(x * x + y * y)};
}
