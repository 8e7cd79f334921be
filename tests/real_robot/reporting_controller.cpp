// Uses every device of its robot: sends each actuator another command at each of its first steps, and prints the
// readings of each sensor in its last step.
#include <cstdio>

#include "ci_controller.h"
#include "ci_range_and_bearing.h"
#include "eyebot/ci_eyebot_attachment_actuator.h"
#include "eyebot/ci_eyebot_laser_actuator.h"
#include "eyebot/ci_eyebot_leds_actuator.h"
#include "eyebot/ci_eyebot_propellers_actuator.h"
#include "footbot/ci_footbot_beacon_actuator.h"
#include "footbot/ci_footbot_gripper_actuator.h"
#include "footbot/ci_footbot_leds_actuator.h"
#include "footbot/ci_footbot_preferential_direction_actuator.h"
#include "footbot/ci_footbot_turret_actuator.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "handbot/ci_handbot_arms_actuator.h"
#include "handbot/ci_handbot_beacon_actuator.h"
#include "handbot/ci_handbot_hands_actuator.h"
#include "handbot/ci_handbot_head_actuator.h"
#include "handbot/ci_handbot_leds_actuator.h"
#include "handbot/ci_handbot_rope_actuator.h"

class CReportingController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    sensors_ = t_tree.GetText("sensors", "");
    last_ = static_cast<std::uint64_t>(t_tree.GetInteger("last", 10));
    return RETURN_OK;
  }

  void ControlStep() override
  {
    const std::uint64_t step = GetRobot()->GetTick();
    const bool early = step < last_ / 2;
    SetFootbot(early);
    SetEyebot(early);
    SetHandbot(early);
    if (step == last_) Report();
  }

private:
  template <class Interface>
  Interface* Find(const char* type)
  {
    return GetRobot()->HasActuator(type) ? &GetRobot()->Actuator<Interface>(type) : nullptr;
  }

  void SetFootbot(bool early)
  {
    if (auto* wheels = Find<CCI_FootBotWheelsActuator>("footbot_wheels"))
      early ? wheels->SetFootBotWheelsAngularVelocity(2, 4) : wheels->SetFootBotWheelsAngularVelocity(-1000, 1000);
    if (auto* beacon = Find<CCI_FootBotBeaconActuator>("footbot_beacon")) beacon->SetColour(0xff8000);
    if (auto* gripper = Find<CCI_FootBotGripperActuator>("footbot_gripper")) gripper->SetGripper(early ? 0.25 : 1);
    if (auto* turret = Find<CCI_FootBotTurretActuator>("footbot_turret"))
      turret->SetTurretAngularVelocity(early ? 0.5 : -5);
    if (auto* sender = Find<CCI_RangeAndBearingActuator>("range_and_bearing"))
      early ? sender->SetMessage({0, 1, 2, 3, 4, 5, 6, 7, 8, 255}) : sender->StopSending();
    if (auto* leds = Find<CCI_FootBotLedsActuator>("footbot_leds"))
    {
      leds->SetAllColours(0x00ff00);
      leds->SetColour(1, 0xff00ff);
    }
    if (auto* direction = Find<CCI_FootBotPreferentialDirectionActuator>("footbot_preferential_direction"))
      direction->SetDirection(0, 0xff0000);
  }

  void SetEyebot(bool early)
  {
    if (auto* propellers = Find<CCI_EyeBotPropellersActuator>("eyebot_propellers"))
      early ? propellers->SetVelocity(0.3, -0.2, 0.1, 3) : propellers->SetPosition({1, 2, 1.5}, 1.5707963267948966);
    if (auto* laser = Find<CCI_EyeBotLaserActuator>("eyebot_laser"))
    {
      early ? laser->SwitchOff() : laser->SwitchOn();
      laser->SetColour(0x00ff00);
      laser->SetDirection(4.71238898038469, 2);
    }
    if (auto* magnet = Find<CCI_EyeBotAttachmentActuator>("eyebot_attachment"))
      early ? magnet->Detach() : magnet->Attach();
    if (auto* leds = Find<CCI_EyeBotLedsActuator>("eyebot_leds")) leds->SetAllColours(0xff0000);
  }

  void SetHandbot(bool early)
  {
    if (auto* head = Find<CCI_HandBotHeadActuator>("handbot_head")) head->SetHeadAngularVelocity(early ? 0.5 : -9);
    if (auto* arms = Find<CCI_HandBotArmsActuator>("handbot_arms"))
    {
      arms->SetArmVelocities(0.1, 0.2);
      arms->SetWristVelocities(0.3, 9);
    }
    if (auto* hands = Find<CCI_HandBotHandsActuator>("handbot_hands"))
    {
      hands->Close(CCI_HandBotHandsActuator::LEFT);
      hands->Open(CCI_HandBotHandsActuator::RIGHT);
    }
    if (auto* rope = Find<CCI_HandBotRopeActuator>("handbot_rope"))
    {
      early ? rope->Release() : rope->Launch();
      rope->SetWinchVelocity(early ? 0.1 : -1);
    }
    if (auto* beacon = Find<CCI_HandBotBeaconActuator>("handbot_beacon")) beacon->SetColour(0xffffff);
    if (auto* leds = Find<CCI_HandBotLedsActuator>("handbot_leds")) leds->SetAllColours(0x0000ff);
  }

  void Report() const
  {
    for (std::size_t start = 0; start < sensors_.size();)
    {
      const std::size_t end = std::min(sensors_.find(' ', start), sensors_.size());
      const std::string type = sensors_.substr(start, end - start);
      start = end + 1;
      std::vector<CCI_Reading> readings;
      GetRobot()->GetSensor(type)->Describe(readings);
      for (const CCI_Reading& reading : readings)
        std::printf("%s\t%s\t%s\t%.9g\n", type.c_str(), reading.name.c_str(), reading.unit.c_str(), reading.value);
    }
  }

  std::string sensors_;
  std::uint64_t last_ = 0;
};

REGISTER_CONTROLLER(CReportingController, "reporting_controller")
