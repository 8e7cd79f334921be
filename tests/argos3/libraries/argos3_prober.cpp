// E-pucks that send long messages, look for lights and turn noisy wheels, and loop functions that cast rays.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_light_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>
#include <argos3/plugins/simulator/entities/wheeled_entity.h>

using namespace argos;

class CProbe : public CCI_Controller
{
public:
  void Init(TConfigurationNode&) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    encoders_ = GetSensor<CCI_DifferentialSteeringSensor>("differential_steering");
    sender_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    receiver_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
    light_ = GetSensor<CCI_LightSensor>("light");
  }
  void ControlStep() override
  {
    CByteArray data(sender_->GetSize());
    for (size_t i = 0; i < data.Size(); ++i) data[i] = static_cast<UInt8>(3 * i + GetId()[0]);
    sender_->SetData(data);
    if (GetId() == "a") LOG << "rolled " << encoders_->GetReading().VelocityLeftWheel << std::endl;
    for (const auto& packet : receiver_->GetReadings()) LOG << "heard " << packet.Data << std::endl;
    LOG << "light";
    for (const Real reading : light_->GetReadings()) LOG << " " << reading;
    LOG << std::endl;
    wheels_->SetLinearVelocity(GetId() == "a" ? 5 : 0, 0);
  }

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_DifferentialSteeringSensor* encoders_ = nullptr;
  CCI_RangeAndBearingActuator* sender_ = nullptr;
  CCI_RangeAndBearingSensor* receiver_ = nullptr;
  CCI_LightSensor* light_ = nullptr;
};

class CProber : public CLoopFunctions
{
public:
  void Init(TConfigurationNode&) override { Cast("init"); }
  void PostStep() override
  {
    if (GetSpace().GetSimulationClock() != 3) return;
    Cast("step");
    auto& puck = dynamic_cast<CEPuckEntity&>(GetSpace().GetEntity("a"));
    CWheeledEntity& wheels = puck.GetWheeledEntity();
    LOG << "wheels " << wheels.GetNumWheels() << " " << wheels.GetWheelPosition(1) << " " << wheels.GetWheelRadius(0)
        << " " << wheels.GetWheelVelocity(0) << " " << wheels.GetWheelVelocity(1) << " "
        << GetSpace().GetEntitiesByType("wheels").size() << std::endl;
    auto& robot = dynamic_cast<CFootBotEntity&>(GetSpace().GetEntity("fb"));
    for (const size_t wheel : {0, 2})
    {
      try
      {
        LOG << robot.GetWheeledEntity().GetWheelVelocity(wheel) << std::endl;
      }
      catch (CARGoSException& refused)
      {
        LOG << refused.what() << std::endl;
      }
    }
    CRABEquippedEntity& radio = puck.GetRABEquippedEntity();
    LOG << "sends " << radio.GetData() << " of " << radio.GetMsgSize() << std::endl;
    CByteArray data(radio.GetMsgSize());
    data[23] = 99;
    radio.SetData(data);
    LOG << "set " << radio.GetData() << std::endl;
  }

private:
  void Cast(const char* when)
  {
    const CRay3 ray(CVector3(-1.5, 0, 0.03), CVector3(1.5, 0, 0.03));
    TEmbodiedEntityIntersectionData met;
    const bool meets = GetEmbodiedEntitiesIntersectedByRay(met, ray);
    LOG << when << " meets " << meets;
    for (const auto& item : met) LOG << " " << item.IntersectedEntity->GetRootEntity().GetId() << "=" << item.TOnRay;
    SEmbodiedEntityIntersectionItem nearest;
    GetClosestEmbodiedEntityIntersectedByRay(nearest, ray);
    LOG << " nearest " << nearest.IntersectedEntity->GetRootEntity().GetId();
    GetClosestEmbodiedEntityIntersectedByRay(nearest, ray, *nearest.IntersectedEntity);
    LOG << " behind " << nearest.IntersectedEntity->GetRootEntity().GetId();
    const CRay3 high(CVector3(-1.5, 0, 0.9), CVector3(1.5, 0, 0.9));
    const bool above = GetClosestEmbodiedEntityIntersectedByRay(nearest, high);
    LOG << " above " << above << (nearest.IntersectedEntity == nullptr)
        << GetEmbodiedEntitiesIntersectedByRay(met, high) << met.size() << std::endl;
  }
};

REGISTER_CONTROLLER(CProbe, "probe")
REGISTER_LOOP_FUNCTIONS(CProber, "prober")
