// A Khepera IV that prints the readings of its sensors in its third step and drives, and loop functions that make
// another one.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ground_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_lidar_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_light_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_proximity_sensor.h>
#include <argos3/plugins/robots/kheperaiv/control_interface/ci_kheperaiv_ultrasound_sensor.h>
#include <argos3/plugins/robots/kheperaiv/simulator/kheperaiv_entity.h>

using namespace argos;

class CKhepera : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    leds_ = GetActuator<CCI_LEDsActuator>("leds");
    sender_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    receiver_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
    proximity_ = GetSensor<CCI_KheperaIVProximitySensor>("kheperaiv_proximity");
    ultrasound_ = GetSensor<CCI_KheperaIVUltrasoundSensor>("kheperaiv_ultrasound");
    light_ = GetSensor<CCI_KheperaIVLightSensor>("kheperaiv_light");
    ground_ = GetSensor<CCI_KheperaIVGroundSensor>("kheperaiv_ground");
    lidar_ = GetSensor<CCI_KheperaIVLIDARSensor>("kheperaiv_lidar");
    encoders_ = GetSensor<CCI_DifferentialSteeringSensor>("differential_steering");
    GetNodeAttribute(node, "left", left_);
    GetNodeAttribute(node, "right", right_);
  }
  void ControlStep() override
  {
    wheels_->SetLinearVelocity(left_, right_);
    leds_->SetSingleColor(2, CColor::RED);
    sender_->SetData(9, 7);
    if (++steps_ == 4) LOG << "off " << lidar_->GetReading(1) << std::endl;
    if (steps_ != 3) return;
    Say("proximity", proximity_->GetReadings());
    Say("ultrasound", ultrasound_->GetReadings());
    Say("light", light_->GetReadings());
    LOG << "ground";
    for (const auto& reading : ground_->GetReadings()) LOG << " " << reading.Offset << "=" << reading.Value;
    LOG << std::endl << "lidar";
    for (UInt32 i = 0; i < lidar_->GetNumReadings(); ++i) LOG << " " << lidar_->GetReading(i);
    LOG << std::endl << "leds " << leds_->GetNumLEDs() << " heard";
    for (const auto& packet : receiver_->GetReadings()) LOG << " " << packet.Data.Size() << ":" << +packet.Data[9];
    LOG << std::endl;
    const auto& rolled = encoders_->GetReading();
    LOG << "rolled " << rolled.VelocityLeftWheel << " " << rolled.CoveredDistanceRightWheel << " "
        << rolled.WheelAxisLength << std::endl;
    lidar_->LaserOff();
  }

private:
  template <class Readings>
  static void Say(const char* name, const Readings& readings)
  {
    LOG << name;
    for (const auto& reading : readings) LOG << " " << ToDegrees(reading.Angle).GetValue() << "=" << reading.Value;
    LOG << std::endl;
  }

  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_LEDsActuator* leds_ = nullptr;
  CCI_RangeAndBearingActuator* sender_ = nullptr;
  CCI_RangeAndBearingSensor* receiver_ = nullptr;
  CCI_KheperaIVProximitySensor* proximity_ = nullptr;
  CCI_KheperaIVUltrasoundSensor* ultrasound_ = nullptr;
  CCI_KheperaIVLightSensor* light_ = nullptr;
  CCI_KheperaIVGroundSensor* ground_ = nullptr;
  CCI_KheperaIVLIDARSensor* lidar_ = nullptr;
  CCI_DifferentialSteeringSensor* encoders_ = nullptr;
  Real left_ = 0, right_ = 0;
  int steps_ = 0;
};

class CKheperaFloor : public CLoopFunctions
{
public:
  void Init(TConfigurationNode&) override { AddEntity(*new CKheperaIVEntity("made", "kc", CVector3(-2, -2, 0))); }
  void PostStep() override
  {
    for (auto& [id, any] : GetSpace().GetEntitiesByType("kheperaiv"))
    {
      auto& khepera = *any_cast<CKheperaIVEntity*>(any);
      const SAnchor& body = khepera.GetEmbodiedEntity().GetOriginAnchor();
      CRadians heading, pitch, roll;
      body.Orientation.ToEulerAngles(heading, pitch, roll);
      LOG << "at " << id << " " << body.Position << " " << ToDegrees(heading).GetValue() << " "
          << khepera.GetLEDEquippedEntity().GetLED(2).GetColor() << std::endl;
      if (GetSpace().GetSimulationClock() != 2) continue;
      LOG << "parts " << khepera.GetUltrasoundSensorEquippedEntity().GetSensor(1).Offset.Length() << " "
          << khepera.GetUltrasoundSensorEquippedEntity().GetSensor(1).Direction.Length() << " "
          << khepera.GetProximitySensorEquippedEntity().GetNumSensors() << " "
          << khepera.GetGroundSensorEquippedEntity().GetSensor(3).Offset << " "
          << khepera.GetRABEquippedEntity().GetMsgSize() << std::endl;
    }
  }
  CColor GetFloorColor(const CVector2& place) override { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }
};

REGISTER_CONTROLLER(CKhepera, "khepera")
REGISTER_LOOP_FUNCTIONS(CKheperaFloor, "khepera_floor")
