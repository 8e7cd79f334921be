// Looks for the loudest sound. It drives towards the sound, turns away from obstacles that it touches, tells the others
// by radio when it has arrived, and saves its battery.
#pragma once

#include "ci_battery_sensor.h"
#include "ci_contact_sensor.h"
#include "ci_controller.h"
#include "ci_distance_scanner_sensor.h"
#include "ci_functions_channel.h"
#include "ci_gyroscope_sensor.h"
#include "ci_microphone_sensor.h"
#include "ci_radio.h"
#include "ci_tag_reader_sensor.h"
#include "footbot/ci_footbot_beacon_actuator.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CSoundSeeker : public swarmanoid::CCI_Controller
{
public:
  int Init(swarmanoid::TConfigurationTree t_tree) override;
  void ControlStep() override;
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;
  std::string StatusText() const override;

private:
  void Listen();
  // Sets the wheel speeds towards the sound, around obstacles.
  void Drive();

  swarmanoid::CCI_FootBotWheelsActuator* wheels_ = nullptr;
  swarmanoid::CCI_FootBotBeaconActuator* beacon_ = nullptr;
  swarmanoid::CCI_RadioActuator* sender_ = nullptr;
  swarmanoid::CCI_ReportActuator* report_ = nullptr;
  const swarmanoid::CCI_RadioSensor* receiver_ = nullptr;
  const swarmanoid::CCI_MicrophoneSensor* microphone_ = nullptr;
  const swarmanoid::CCI_ContactSensor* contact_ = nullptr;
  const swarmanoid::CCI_GyroscopeSensor* gyroscope_ = nullptr;
  const swarmanoid::CCI_BatterySensor* battery_ = nullptr;
  const swarmanoid::CCI_DistanceScannerSensor* scanner_ = nullptr;
  const swarmanoid::CCI_TagReaderSensor* tags_ = nullptr;
  double velocity_m_s_ = 0;
  unsigned heard_ = 0;  // packets of robots that have arrived
  bool has_arrived_ = false;
};
