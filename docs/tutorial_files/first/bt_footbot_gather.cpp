#include "bt_footbot_gather.h"

#include "ci_colour.h"

CBTFootbotGather::CBTFootbotGather() : CCI_Behavior("gather"), go_to_light_(CCI_Colour::BLUE)
{
  State<std::string>* wander = initializeState(this, WANDER, "[WANDER]");
  State<std::string>* join = initializeState(this, JOIN, "[JOIN]");
  State<std::string>* rest = initializeState(this, REST, "[REST]");
  wander->addTransition("lightSeen", join);
  wander->addTransition("greenFound", rest);
  join->addTransition("lightLost", wander);
  join->addTransition("greenFound", rest);
  setStartState(wander);
}

void CBTFootbotGather::Step(CCI_FootBotState& cRobotState)
{
  const bool stays = CCI_Colour::Nearest(cRobotState.GetFloorColour()) == CCI_Colour::GREEN;
  const CCI_ColourBlob* light = cRobotState.GetNearestColourBlob(CCI_Colour::BLUE);
  const bool joins = light != nullptr;
  input(stays ? "greenFound" : joins ? "lightSeen" : "lightLost");

  cRobotState.SetAllLedColours(GetStateID() == REST ? CCI_Colour::BLUE : CCI_Colour::BLACK);
  if (GetStateID() == REST)
  {
    cRobotState.SetFootBotWheelsAngularVelocity(0, 0);
    return;
  }
  if (GetStateID() == JOIN)
    go_to_light_.Step(cRobotState);
  else
    random_walk_.Step(cRobotState);
  obstacle_avoidance_.Step(cRobotState);  // the last one has priority
}
