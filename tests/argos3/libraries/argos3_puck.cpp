// An e-puck that drives straight on and prints the readings of its sensors in its third step, and a floor that is black
// ahead.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_proximity_sensor.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_ground_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

using namespace argos;

class CPuck : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    leds_ = GetActuator<CCI_LEDsActuator>("leds");
    sender_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    receiver_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
    proximity_ = GetSensor<CCI_ProximitySensor>("proximity");
    own_ = GetSensor<CCI_EPuckProximitySensor>("epuck_proximity");
    ground_ = GetSensor<CCI_GroundSensor>("ground");
    encoders_ = GetSensor<CCI_DifferentialSteeringSensor>("differential_steering");
    GetNodeAttribute(node, "velocity", velocity_);
  }
  void ControlStep() override
  {
    const auto& rolled = encoders_->GetReading();
    LOG << "rolled " << rolled.VelocityLeftWheel << " " << rolled.VelocityRightWheel << " "
        << rolled.CoveredDistanceLeftWheel << " " << rolled.CoveredDistanceRightWheel << " " << rolled.WheelAxisLength
        << std::endl;
    wheels_->SetLinearVelocity(velocity_, velocity_);
    leds_->SetAllColors(CColor::RED);
    sender_->SetData(1, 7);
    if (++steps_ != 3) return;
    LOG << "generic";
    for (const Real reading : proximity_->GetReadings()) LOG << " " << reading;
    LOG << std::endl << "own";
    for (const auto& reading : own_->GetReadings()) LOG << " " << ToDegrees(reading.Angle) << "=" << reading.Value;
    LOG << std::endl << "ground";
    for (const Real reading : ground_->GetReadings()) LOG << " " << reading;
    LOG << std::endl << "leds " << leds_->GetNumLEDs() << " heard";
    for (const auto& packet : receiver_->GetReadings()) LOG << " " << packet.Data.Size() << ":" << +packet.Data[1];
    LOG << std::endl;
  }

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_LEDsActuator* leds_ = nullptr;
  CCI_RangeAndBearingActuator* sender_ = nullptr;
  CCI_RangeAndBearingSensor* receiver_ = nullptr;
  CCI_ProximitySensor* proximity_ = nullptr;
  CCI_EPuckProximitySensor* own_ = nullptr;
  CCI_GroundSensor* ground_ = nullptr;
  CCI_DifferentialSteeringSensor* encoders_ = nullptr;
  Real velocity_ = 0;
  int steps_ = 0;
};

class CPuckFloor : public CLoopFunctions
{
public:
  void PostStep() override
  {
    Say(*any_cast<CEPuckEntity*>(GetSpace().GetEntitiesByType("e-puck")["front"]));
    for (auto& [id, any] : GetSpace().GetEntitiesByType("e-puck"))
      LOG << "at " << id << " " << any_cast<CEPuckEntity*>(any)->GetEmbodiedEntity().GetOriginAnchor().Position
          << std::endl;
  }
  CColor GetFloorColor(const CVector2& place) override { return place.GetY() > 0 ? CColor::BLACK : CColor::WHITE; }

private:
  // Logs the message, the range and the sensors of the e-puck, and that data of another size is refused.
  void Say(CEPuckEntity& puck)
  {
    CRABEquippedEntity& radio = puck.GetRABEquippedEntity();
    LOG << "sends " << radio.GetData() << " of " << radio.GetMsgSize() << " as far as " << radio.GetRange()
        << std::endl;
    if (GetSpace().GetSimulationClock() != 2) return;
    auto& proximity = puck.GetProximitySensorEquippedEntity();
    LOG << "sensors " << proximity.GetNumSensors() << " " << proximity.GetSensor(2).Offset.GetY() << " "
        << proximity.GetSensor(2).Direction.Length() << " " << puck.GetLightSensorEquippedEntity().GetNumSensors()
        << " " << puck.GetGroundSensorEquippedEntity().GetSensor(2).Offset << std::endl;
    CByteArray data(2, 200);
    radio.SetData(data);
    LOG << "set " << radio.GetData() << std::endl;
    for (const size_t size : {size_t{1}, size_t{3}})
    {
      try
      {
        radio.SetData(CByteArray(size));
      }
      catch (CARGoSException& refused)
      {
        LOG << refused.what() << std::endl;
      }
    }
    try
    {
      radio.SetRange(radio.GetRange());
      radio.SetRange(2);
    }
    catch (CARGoSException& refused)
    {
      LOG << refused.what() << std::endl;
    }
  }
};

REGISTER_CONTROLLER(CPuck, "puck")
REGISTER_LOOP_FUNCTIONS(CPuckFloor, "puck_floor")
