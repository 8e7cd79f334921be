#include "common/control_interface/behavior/ci_handbot_state.h"

#include <algorithm>

namespace swarmanoid
{

void CCI_HandBotState::Init()
{
  InitCommon();
  devices_.joints = FindSensor<CCI_HandBotJointsSensor>("handbot_joints");
  devices_.arms = FindActuator<CCI_HandBotArmsActuator>("handbot_arms");
  devices_.head = FindActuator<CCI_HandBotHeadActuator>("handbot_head");
  devices_.hands = FindActuator<CCI_HandBotHandsActuator>("handbot_hands");
  devices_.rope = FindActuator<CCI_HandBotRopeActuator>("handbot_rope");
  devices_.beacon = FindActuator<CCI_HandBotBeaconActuator>("handbot_beacon");
}

void CCI_HandBotState::ReadSensors()
{
  ReadCommonSensors();
  if (devices_.joints != nullptr)
  {
    const auto readings = devices_.joints->GetAllSensorReadings();
    std::copy(readings.begin(), readings.end(), joints_.begin());
    for (const auto hand : {CCI_HandBotHandsActuator::LEFT, CCI_HandBotHandsActuator::RIGHT})
      held_ids_.at(hand) = devices_.joints->GetHeldId(hand);
  }
}

void CCI_HandBotState::WriteActuators()
{
  WriteCommonActuators();
  arms_.Flush([this](const auto& v) { devices_.arms->SetArmVelocities(v[0], v[1]); });
  wrists_.Flush([this](const auto& v) { devices_.arms->SetWristVelocities(v[0], v[1]); });
  head_.Flush([this](double v) { devices_.head->SetHeadAngularVelocity(v); });
  for (const auto hand : {CCI_HandBotHandsActuator::LEFT, CCI_HandBotHandsActuator::RIGHT})
    hands_closed_[hand].Flush([&](bool closed) { closed ? devices_.hands->Close(hand) : devices_.hands->Open(hand); });
  rope_launched_.Flush([this](bool launched) { launched ? devices_.rope->Launch() : devices_.rope->Release(); });
  winch_.Flush([this](double v) { devices_.rope->SetWinchVelocity(v); });
  beacon_.Flush([this](std::uint32_t colour) { devices_.beacon->SetColour(colour); });
}

double CCI_HandBotState::GetJoint(CCI_HandBotJointsSensor::Reading joint) const
{
  RequireSensor(devices_.joints, "handbot_joints");
  return joints_.at(joint);
}

bool CCI_HandBotState::IsHolding(CCI_HandBotHandsActuator::Hand hand) const
{
  return GetJoint(hand == CCI_HandBotHandsActuator::LEFT ? CCI_HandBotJointsSensor::HOLDS_LEFT
                                                         : CCI_HandBotJointsSensor::HOLDS_RIGHT) != 0;
}

const std::string& CCI_HandBotState::GetHeldId(CCI_HandBotHandsActuator::Hand hand) const
{
  RequireSensor(devices_.joints, "handbot_joints");
  return held_ids_.at(hand);
}

void CCI_HandBotState::SetArmVelocities(double left, double right)
{
  Command(devices_.arms, "handbot_arms", arms_, {left, right});
}

void CCI_HandBotState::SetWristVelocities(double left, double right)
{
  Command(devices_.arms, "handbot_arms", wrists_, {left, right});
}

void CCI_HandBotState::SetHeadAngularVelocity(double velocity)
{
  Command(devices_.head, "handbot_head", head_, velocity);
}

void CCI_HandBotState::CloseHand(CCI_HandBotHandsActuator::Hand hand)
{
  RequireActuator(devices_.hands, "handbot_hands");
  hands_closed_.at(hand).Set(true);
}

void CCI_HandBotState::OpenHand(CCI_HandBotHandsActuator::Hand hand)
{
  RequireActuator(devices_.hands, "handbot_hands");
  hands_closed_.at(hand).Set(false);
}

void CCI_HandBotState::LaunchRope() { Command(devices_.rope, "handbot_rope", rope_launched_, true); }

void CCI_HandBotState::ReleaseRope() { Command(devices_.rope, "handbot_rope", rope_launched_, false); }

void CCI_HandBotState::SetWinchVelocity(double velocity) { Command(devices_.rope, "handbot_rope", winch_, velocity); }

void CCI_HandBotState::SetBeaconColour(std::uint32_t colour)
{
  Command(devices_.beacon, "handbot_beacon", beacon_, colour);
}

}  // namespace swarmanoid
