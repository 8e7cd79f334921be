#include "handbot_shelf.h"

#include <istream>
#include <ostream>

namespace
{

constexpr double kArmSpeed = 0.5;  // rad/s
constexpr double kSpread = 1.0;    // rad
constexpr double kForward = 0.01;  // rad
constexpr double kLiftOff = 0.2;   // m: the robot leans forward under the load; the object must clear the board

}  // namespace

int CHandBotShelf::Init(const TConfigurationTree t_tree)
{
  arms_ = &GetRobot()->Actuator<CCI_HandBotArmsActuator>("handbot_arms");
  hands_ = &GetRobot()->Actuator<CCI_HandBotHandsActuator>("handbot_hands");
  rope_ = &GetRobot()->Actuator<CCI_HandBotRopeActuator>("handbot_rope");
  joints_ = &GetRobot()->Sensor<CCI_HandBotJointsSensor>("handbot_joints");
  climb_m_ = t_tree.GetNumber("climb");
  winch_m_s_ = t_tree.GetNumber("winch");
  return RETURN_OK;
}

void CHandBotShelf::Next(Phase phase) { phase_ = phase; }

void CHandBotShelf::ControlStep()
{
  using Joints = CCI_HandBotJointsSensor;
  const double left_arm = joints_->GetReading(Joints::ARM_LEFT);
  const double rope_m = joints_->GetReading(Joints::ROPE_LENGTH);
  const bool holds = joints_->GetReading(Joints::HOLDS_LEFT) > 0.5;
  arms_->SetArmVelocities(0, 0);
  rope_->SetWinchVelocity(0);

  switch (phase_)
  {
    case kLaunch:
      rope_->Launch();
      arms_->SetArmVelocities(kArmSpeed, kArmSpeed);
      rope_at_floor_m_ = rope_m;
      if (joints_->GetReading(Joints::ROPE_ATTACHED) > 0.5 && left_arm >= kSpread) Next(kClimb);
      break;
    case kClimb:
      rope_->SetWinchVelocity(-winch_m_s_);
      if (rope_m <= rope_at_floor_m_ - climb_m_) Next(kReach);
      break;
    case kReach:
      arms_->SetArmVelocities(-kArmSpeed, -kArmSpeed);
      if (left_arm <= kForward) hands_->Close(CCI_HandBotHandsActuator::LEFT);
      if (holds) Next(kLift);
      break;
    case kLift:
      rope_->SetWinchVelocity(-winch_m_s_);
      if (rope_m <= rope_at_floor_m_ - climb_m_ - kLiftOff) Next(kSwing);
      break;
    case kSwing:
      arms_->SetArmVelocities(kArmSpeed, kArmSpeed);
      if (left_arm >= kSpread) Next(kDescend);
      break;
    case kDescend:
      rope_->SetWinchVelocity(winch_m_s_);
      if (rope_m >= rope_at_floor_m_ + 0.02) Next(kPutDown);
      break;
    case kPutDown:
      hands_->Open(CCI_HandBotHandsActuator::LEFT);
      if (!holds) Next(kDone);
      break;
    default:
      break;
  }
}

void CHandBotShelf::SaveState(std::ostream& state) const
{
  state.write(reinterpret_cast<const char*>(&phase_), sizeof phase_);
  state.write(reinterpret_cast<const char*>(&rope_at_floor_m_), sizeof rope_at_floor_m_);
}

void CHandBotShelf::LoadState(std::istream& state)
{
  state.read(reinterpret_cast<char*>(&phase_), sizeof phase_);
  state.read(reinterpret_cast<char*>(&rope_at_floor_m_), sizeof rope_at_floor_m_);
}

REGISTER_CONTROLLER(CHandBotShelf,
                    {.label = "handbot_shelf",
                     .brief = "climbs to a shelf, takes the book and brings it down",
                     .parameters = {{.name = "climb",
                                     .unit = "m",
                                     .default_value = "1",
                                     .description = "Rope to take in until the hands are before the thing.",
                                     .minimum = 0,
                                     .maximum = 1e6},
                                    {.name = "winch",
                                     .unit = "m/s",
                                     .default_value = "0.1",
                                     .description = "Velocity of the rope; the actuator limits it, too.",
                                     .minimum = 0,
                                     .maximum = 1000}}})
