// Functions for driving a footbot that many behaviours share.
#pragma once

#include "behavior/ci_footbot_state.h"

// Drives towards a direction (radians counter-clockwise from the front) at up to `speed` m/s. The difference of the
// wheels is proportional to the angle; for a direction behind, the robot turns on the spot.
void BTFootbotSteer(CCI_FootBotState& cRobotState, double direction, double speed);

// Turns on the spot by up to `angle` radians in this tick, with the wheels at `speed` m/s at most. Returns the angle
// that it turns.
double BTFootbotTurn(CCI_FootBotState& cRobotState, double angle, double speed);

// The direction and length of the sum of the proximity readings as vectors. The length is 0 if nothing is near.
struct BTVector
{
  double angle = 0;
  double length = 0;
};
BTVector BTFootbotProximityVector(const CCI_FootBotState& cRobotState);
