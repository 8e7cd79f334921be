#include "sound_seeker.h"

#include <algorithm>
#include <array>
#include <istream>
#include <ostream>
#include <string>

#include "common/math/elementary.h"

using namespace swarmanoid;

int CSoundSeeker::Init(const TConfigurationTree t_tree)
{
  CCI_Robot& robot = *GetRobot();
  wheels_ = &robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  beacon_ = &robot.Actuator<CCI_FootBotBeaconActuator>("footbot_beacon");
  sender_ = &robot.Actuator<CCI_RadioActuator>("radio");
  report_ = &robot.Actuator<CCI_ReportActuator>("report");
  receiver_ = &robot.Sensor<CCI_RadioSensor>("radio");
  microphone_ = &robot.Sensor<CCI_MicrophoneSensor>("microphone");
  contact_ = &robot.Sensor<CCI_ContactSensor>("contact");
  gyroscope_ = &robot.Sensor<CCI_GyroscopeSensor>("gyroscope");
  battery_ = &robot.Sensor<CCI_BatterySensor>("battery");
  scanner_ = &robot.Sensor<CCI_DistanceScannerSensor>("footbot_distance_scanner");
  tags_ = &robot.Sensor<CCI_TagReaderSensor>("tag_reader");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  return RETURN_OK;
}

void CSoundSeeker::ControlStep()
{
  Listen();
  const bool was_there = has_arrived_;
  has_arrived_ |= !tags_->GetAllTags().empty();
  if (has_arrived_ && !was_there) GetRobot()->Log("reads the tag " + std::string(tags_->GetAllTags()[0].id));
  if (has_arrived_ && GetRobot()->GetTick() % 10 == 0)
    sender_->Send(std::array{static_cast<std::uint8_t>(100 * battery_->GetCharge())});
  report_->Report(battery_->GetCharge());
  beacon_->SetColour(has_arrived_ ? 0x00ff00 : heard_ > 0 ? 0xffff00 : 0xff0000);
  Drive();
}

void CSoundSeeker::Listen() { heard_ += static_cast<unsigned>(receiver_->GetAllPackets().size()); }

void CSoundSeeker::Drive()
{
  if (has_arrived_ || battery_->GetCharge() < 0.1) return wheels_->SetFootBotWheelsLinearVelocity(0, 0);
  double left = velocity_m_s_;
  double right = velocity_m_s_;
  const auto turn = [&](double by)  // to the left if positive
  {
    left -= by * velocity_m_s_;
    right += by * velocity_m_s_;
  };
  const CCI_MicrophoneSensor::Sound* loudest = nullptr;
  for (const auto& sound : microphone_->GetAllSounds())
    if (loudest == nullptr || sound.loudness > loudest->loudness) loudest = &sound;
  if (loudest != nullptr) turn(std::clamp(loudest->bearing_rad, -1.0, 1.0) - 0.1 * gyroscope_->GetYawRate());
  for (const auto& reading : scanner_->GetAllReadings())
    if (reading.echo == CCI_DistanceScannerSensor::Echo::kMeasured && reading.distance_m < 0.2)
      if (const SinCos direction = SinCosOf(reading.angle_rad); direction.cos > 0) turn(direction.sin > 0 ? -1 : 1);
  for (const double angle : contact_->GetAllContacts()) turn(angle > 0 ? -2 : 2);
  wheels_->SetFootBotWheelsLinearVelocity(left, right);
}

void CSoundSeeker::SaveState(std::ostream& state) const { state << heard_ << ' ' << has_arrived_; }

void CSoundSeeker::LoadState(std::istream& state) { state >> heard_ >> has_arrived_; }

std::string CSoundSeeker::StatusText() const
{
  return (has_arrived_ ? "there" : "on its way") + std::string(", heard of ") + std::to_string(heard_);
}

REGISTER_CONTROLLER(CSoundSeeker,
                    {.label = "sound_seeker",
                     .brief = "drives to the loudest sound and tells the others by radio that it is there",
                     .parameters = {{.name = "velocity",
                                     .unit = "m/s",
                                     .default_value = "0.1",
                                     .description = "Of a robot that drives straight on.",
                                     .minimum = 0,
                                     .maximum = 1000}}})
