// A foot-bot that wanders by the API of ARGoS3. It turns away from sensed bodies, and now and then at random. Its
// beacon shows how many other robots it hears, and it sends them its mood.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/utility/configuration/argos_configuration.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/math/rng.h>
#include <argos3/core/utility/math/vector2.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

using namespace argos;

class CWanderer : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    leds_ = GetActuator<CCI_LEDsActuator>("leds");
    sender_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    proximity_ = GetSensor<CCI_FootBotProximitySensor>("footbot_proximity");
    receiver_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
    GetNodeAttribute(node, "velocity", velocity_);
    GetNodeAttributeOrDefault(GetNode(node, "turns"), "angles", turns_, turns_);
    random_ = CRandom::CreateRNG("argos");
  }

  void ControlStep() override
  {
    CVector2 away;
    for (const auto& reading : proximity_->GetReadings()) away -= CVector2(reading.Value, reading.Angle);
    if (away.Length() > 0.1)
      turn_ = away.Angle();
    else if (random_->Bernoulli(0.05))
      turn_ = random_->Uniform(CRange<CRadians>(ToRadians(turns_.GetMin()), ToRadians(turns_.GetMax())));
    const Real side = turn_.GetValue() > 0.1 ? 1 : turn_.GetValue() < -0.1 ? -1 : 0;
    wheels_->SetLinearVelocity(velocity_ * (1 - side), velocity_ * (1 + side));
    turn_ *= 0.7;
    leds_->SetSingleColor(12, receiver_->GetReadings().empty() ? CColor::BLACK : CColor::BLUE);
    leds_->SetSingleColor(0, CColor::RED);
    sender_->SetData(0, static_cast<UInt8>(random_->Uniform(CRange<UInt32>(1, 200))));
    for (const auto& packet : receiver_->GetReadings())
      if (packet.Range < 30) turn_ += CRadians(packet.Data[0] > 100 ? 0.3 : -0.3);
  }

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_LEDsActuator* leds_ = nullptr;
  CCI_RangeAndBearingActuator* sender_ = nullptr;
  CCI_FootBotProximitySensor* proximity_ = nullptr;
  CCI_RangeAndBearingSensor* receiver_ = nullptr;
  CRandom::CRNG* random_ = nullptr;
  CRange<CDegrees> turns_{CDegrees(-60), CDegrees(60)};
  CRadians turn_;
  Real velocity_ = 0;
};

REGISTER_CONTROLLER(CWanderer, "wanderer")
