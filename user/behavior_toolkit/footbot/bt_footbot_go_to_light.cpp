#include "footbot/bt_footbot_go_to_light.h"

#include <algorithm>

#include "common/math/elementary.h"
#include "footbot/bt_footbot_drive.h"

using namespace swarmanoid;

CBTFootbotGoToLight::CBTFootbotGoToLight(double speed, bool away, double arrived_at)
    : CCI_Behavior(away ? "flee from light" : "go to light"), speed_(speed), away_(away), arrived_at_(arrived_at)
{
}

void CBTFootbotGoToLight::Step(CCI_FootBotState& cRobotState)
{
  double readings[CCI_FootBotState::NUM_LIGHT_SENSORS];
  cRobotState.GetAllLightSensorReadings(readings);
  double x = 0;
  double y = 0;
  double strongest = 0;
  for (unsigned i = 0; i < CCI_FootBotState::NUM_LIGHT_SENSORS; ++i)
  {
    const SinCos direction = SinCosOf(CCI_FootBotState::GetLightSensorAngle(i));
    x += readings[i] * direction.cos;
    y += readings[i] * direction.sin;
    strongest = std::max(strongest, readings[i]);
  }
  if (strongest == 0) return;
  if (!away_ && strongest >= arrived_at_)
    cRobotState.SetFootBotWheelsAngularVelocity(0, 0);
  else
    BTFootbotSteer(cRobotState, Atan2(y, x) + (away_ ? kPi : 0), speed_);
}
