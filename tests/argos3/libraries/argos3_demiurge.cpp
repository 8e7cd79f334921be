// An e-puck of argos3-epuck that prints the readings of its sensors in its third step, and a floor that is black ahead.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_base_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_ground_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_light_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_rgb_leds_actuator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_wheels_actuator.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>

using namespace argos;

class CDemiurgePuck : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    wheels_ = GetActuator<CCI_EPuckWheelsActuator>("epuck_wheels");
    coloured_ = GetActuator<CCI_EPuckRGBLEDsActuator>("epuck_rgb_leds");
    red_ = GetActuator<CCI_EPuckBaseLEDsActuator>("epuck_base_leds");
    sender_ = GetActuator<CCI_EPuckRangeAndBearingActuator>("epuck_range_and_bearing");
    receiver_ = GetSensor<CCI_EPuckRangeAndBearingSensor>("epuck_range_and_bearing");
    proximity_ = GetSensor<CCI_EPuckProximitySensor>("epuck_proximity");
    light_ = GetSensor<CCI_EPuckLightSensor>("epuck_light");
    ground_ = GetSensor<CCI_EPuckGroundSensor>("epuck_ground");
    camera_ = GetSensor<CCI_EPuckOmnidirectionalCameraSensor>("epuck_omnidirectional_camera");
    camera_->Enable();
    GetNodeAttribute(node, "velocity", velocity_);
  }
  void ControlStep() override
  {
    wheels_->SetLinearVelocity(velocity_, velocity_);
    const UInt8 all[] = {1, 2, 3, 4}, left[] = {9, 8, 7, 6};
    if (GetId() == "b")
    {
      coloured_->SetColor(0, CColor::RED);
      coloured_->SetColor(1, CColor::GREEN);
      coloured_->SetColor(2, CColor::BLUE);
      sender_->SetDataForEmitter(3, left);
    }
    else
      sender_->SetData(all);
    red_->SwitchLED(0, GetId() == "c");
    if (++steps_ != 3) return;
    LOG << "proximity";
    for (const auto& reading : proximity_->GetReadings())
      LOG << " " << ToDegrees(reading.Angle).GetValue() << "=" << reading.Value;
    LOG << std::endl << "light";
    for (UInt16 i = 0; i < 8; ++i) LOG << " " << light_->GetReading(i).Value;
    LOG << std::endl
        << "ground " << ground_->GetReadings().Left << " " << ground_->GetReading(1) << " "
        << ground_->GetReadings().Right << std::endl
        << "heard";
    for (const auto* packet : receiver_->GetPackets())
      LOG << " " << packet->Range << "," << packet->Bearing.GetValue() << "," << +packet->Data[0] << +packet->Data[3];
    LOG << std::endl << "sees";
    for (const auto* blob : camera_->GetReadings().BlobList)
      LOG << " " << blob->Distance << "," << blob->Angle.GetValue() << "," << +blob->Color.GetRed() << ":"
          << +blob->Color.GetGreen() << ":" << +blob->Color.GetBlue() << "," << blob->Area;
    LOG << std::endl;
  }

private:
  CCI_EPuckWheelsActuator* wheels_ = nullptr;
  CCI_EPuckRGBLEDsActuator* coloured_ = nullptr;
  CCI_EPuckBaseLEDsActuator* red_ = nullptr;
  CCI_EPuckRangeAndBearingActuator* sender_ = nullptr;
  CCI_EPuckRangeAndBearingSensor* receiver_ = nullptr;
  CCI_EPuckProximitySensor* proximity_ = nullptr;
  CCI_EPuckLightSensor* light_ = nullptr;
  CCI_EPuckGroundSensor* ground_ = nullptr;
  CCI_EPuckOmnidirectionalCameraSensor* camera_ = nullptr;
  Real velocity_ = 0;
  int steps_ = 0;
};

class CDemiurgeFloor : public CLoopFunctions
{
public:
  void PostStep() override
  {
    for (auto& [id, any] : GetSpace().GetEntitiesByType("e-puck"))
    {
      auto& puck = *any_cast<CEPuckEntity*>(any);
      LOG << "at " << id << " " << puck.GetEmbodiedEntity().GetOriginAnchor().Position << " leds "
          << puck.GetLEDEquippedEntity().GetNumLEDs() << " "
          << +puck.GetLEDEquippedEntity().GetLED(7).GetColor().GetRed() << std::endl;
    }
  }
  CColor GetFloorColor(const CVector2& place) override { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }
};

REGISTER_CONTROLLER(CDemiurgePuck, "demiurge_puck")
REGISTER_LOOP_FUNCTIONS(CDemiurgeFloor, "demiurge_floor")
