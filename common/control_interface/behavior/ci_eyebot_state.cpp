#include "common/control_interface/behavior/ci_eyebot_state.h"

namespace swarmanoid
{

void CCI_EyeBotState::Init()
{
  InitCommon();
  devices_.altitude = FindSensor<CCI_EyeBotAltitudeSensor>("eyebot_altitude");
  devices_.propellers = FindActuator<CCI_EyeBotPropellersActuator>("eyebot_propellers");
  devices_.laser = FindActuator<CCI_EyeBotLaserActuator>("eyebot_laser");
  devices_.attachment = FindActuator<CCI_EyeBotAttachmentActuator>("eyebot_attachment");
}

void CCI_EyeBotState::ReadSensors()
{
  ReadCommonSensors();
  if (devices_.altitude != nullptr) altitude_ = devices_.altitude->GetAltitude();
}

void CCI_EyeBotState::WriteActuators()
{
  WriteCommonActuators();
  velocity_.Flush([this](const auto& v) { devices_.propellers->SetVelocity(v[0], v[1], v[2], v[3]); });
  position_.Flush([this](const auto& p) { devices_.propellers->SetPosition({p[0], p[1], p[2]}, p[3]); });
  laser_.Flush(
      [this](const Laser& laser)
      {
        devices_.laser->SetColour(laser.colour);
        devices_.laser->SetDirection(laser.pan, laser.tilt);
        laser.on ? devices_.laser->SwitchOn() : devices_.laser->SwitchOff();
      });
  attached_.Flush([this](bool attached) { attached ? devices_.attachment->Attach() : devices_.attachment->Detach(); });
}

double CCI_EyeBotState::GetAltitude() const { return ReadingOf(devices_.altitude, "eyebot_altitude", altitude_); }

void CCI_EyeBotState::SetVelocity(double forward, double left, double up, double yaw_rate)
{
  RequireActuator(devices_.propellers, "eyebot_propellers");
  velocity_.Set({forward, left, up, yaw_rate});
  position_.Forget();
}

void CCI_EyeBotState::SetPosition(const Vector3& position, double yaw)
{
  RequireActuator(devices_.propellers, "eyebot_propellers");
  position_.Set({position.x(), position.y(), position.z(), yaw});
  velocity_.Forget();
}

void CCI_EyeBotState::SwitchLaserOn(std::uint32_t colour)
{
  RequireActuator(devices_.laser, "eyebot_laser");
  Laser laser = laser_.Get();
  laser.on = true;
  laser.colour = colour;
  laser_.Set(laser);
}

void CCI_EyeBotState::SwitchLaserOff()
{
  RequireActuator(devices_.laser, "eyebot_laser");
  Laser laser = laser_.Get();
  laser.on = false;
  laser_.Set(laser);
}

void CCI_EyeBotState::SetLaserDirection(double pan, double tilt)
{
  RequireActuator(devices_.laser, "eyebot_laser");
  Laser laser = laser_.Get();
  laser.pan = pan;
  laser.tilt = tilt;
  laser_.Set(laser);
}

void CCI_EyeBotState::Attach() { Command(devices_.attachment, "eyebot_attachment", attached_, true); }

void CCI_EyeBotState::Detach() { Command(devices_.attachment, "eyebot_attachment", attached_, false); }

}  // namespace swarmanoid
