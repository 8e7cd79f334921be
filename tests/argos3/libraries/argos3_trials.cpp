// Trials of robots that meet, with noise in all their commands and readings.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_turret_encoder_sensor.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/simulator/entities/box_entity.h>

using namespace argos;

// Drives ahead with a small random part, and sums up its readings.
class CNoisy : public CCI_Controller
{
public:
  void Init(TConfigurationNode&) override
  {
    random_ = CRandom::CreateRNG("argos");
    Begin();
  }
  void Reset() override { Begin(); }
  void Begin()
  {
    GetActuator<CCI_LEDsActuator>("leds")->SetSingleColor(12, CColor::RED);
    GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing")->SetData(0, 1);
    auto& turret = *GetActuator<CCI_FootBotTurretActuator>("footbot_turret");
    turret.SetSpeedControlMode();
    turret.SetRotationSpeed(10);
  }
  void ControlStep() override
  {
    const Real turn = random_->Uniform(CRange<Real>(-2, 2));
    GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(8 + turn, 8 - turn);
    std::ostringstream text;
    text << std::hexfloat;
    const auto& wheels = GetSensor<CCI_DifferentialSteeringSensor>("differential_steering")->GetReading();
    text << wheels.VelocityLeftWheel << ' ' << wheels.CoveredDistanceRightWheel;
    for (const auto& packet : GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing")->GetReadings())
      text << ' ' << packet.Range << ' ' << packet.HorizontalBearing.GetValue();
    const auto& camera =
        GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera")->GetReadings();
    for (const auto* blob : camera.BlobList) text << ' ' << blob->Distance;
    for (const auto& near : GetSensor<CCI_FootBotProximitySensor>("footbot_proximity")->GetReadings())
      text << ' ' << near.Value;
    text << ' ' << GetSensor<CCI_PositioningSensor>("positioning")->GetReading().Position << ' '
         << GetSensor<CCI_BatterySensor>("battery")->GetReading().AvailableCharge << ' '
         << GetSensor<CCI_FootBotTurretEncoderSensor>("footbot_turret_encoder")->GetRotation().GetValue();
    told_ = text.str();
  }
  std::string told_;

private:
  CRandom::CRNG* random_ = nullptr;
};

class CTrials : public CLoopFunctions
{
public:
  void Init(TConfigurationNode& node) override
  {
    GetNodeAttribute(node, "reset", reset_);
    file_.open("trials.tsv");
  }
  void PostStep() override
  {
    file_ << trial_ << '\t' << GetSpace().GetSimulationClock();
    for (const auto& robot : GetSpace().GetEntitiesByType("foot-bot"))
    {
      auto& body = *any_cast<CFootBotEntity*>(robot.second);
      file_ << '\t' << std::hexfloat << body.GetEmbodiedEntity().GetOriginAnchor().Position << '\t'
            << dynamic_cast<CNoisy&>(body.GetControllableEntity().GetController()).told_;
    }
    auto& crate = *any_cast<CBoxEntity*>(GetSpace().GetEntitiesByType("box")["crate"]);
    file_ << '\t' << crate.GetEmbodiedEntity().GetOriginAnchor().Position << '\n';
    if (GetSpace().GetSimulationClock() < 130) return;
    ++trial_;
    if (trial_ == 5) return GetSimulator().Terminate();
    if (reset_ == "space")
      GetSpace().Reset();
    else if (trial_ == 2)
      GetSimulator().Reset(99);
    else if (trial_ == 4)
      GetSimulator().Reset(3);
    else
      GetSimulator().Reset();
  }

private:
  int trial_ = 0;
  std::string reset_;
  std::ofstream file_;
};

REGISTER_CONTROLLER(CNoisy, "noisy")
REGISTER_LOOP_FUNCTIONS(CTrials, "trials")
