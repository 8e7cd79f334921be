#include "common/control_interface/behavior/ci_robot_state.h"

namespace swarmanoid
{

void CCI_RobotState::InitCommon()
{
  receiver_ = FindSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
  sender_ = FindActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
}

void CCI_RobotState::ReadCommonSensors()
{
  if (receiver_ == nullptr) return;
  const auto packets = receiver_->GetAllPackets();
  packets_.assign(packets.begin(), packets.end());
}

void CCI_RobotState::WriteCommonActuators()
{
  message_.Flush([this](const Message& message)
                 { message.sending ? sender_->SetMessage(message.bytes) : sender_->StopSending(); });
}

const std::vector<CCI_RangeAndBearingSensor::Packet>& CCI_RobotState::GetRangeAndBearingPackets() const
{
  return ReadingOf(receiver_, "range_and_bearing", packets_);
}

void CCI_RobotState::SetRangeAndBearingMessage(const CCI_RangeAndBearingActuator::Message& message)
{
  Command(sender_, "range_and_bearing", message_, {true, message});
}

void CCI_RobotState::StopRangeAndBearing() { Command(sender_, "range_and_bearing", message_, {}); }

}  // namespace swarmanoid
