// A sensor and an actuator of a user, registered by REGISTER_SENSOR and REGISTER_ACTUATOR, and a controller with both.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/actuator.h>
#include <argos3/core/simulator/entity/embodied_entity.h>
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/simulator/sensor.h>
#include <argos3/core/simulator/simulator.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/math/rng.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>

namespace argos
{

class CCI_NeighbourSensor : public CCI_Sensor
{
public:
  Real GetNearest() const { return nearest_; }
  Real GetAhead() const { return ahead_; }

protected:
  Real nearest_ = 0;  // the distance to the nearest robot in range, m; 0: there is none
  Real ahead_ = 0;    // the distance from the middle of the robot to a body ahead, m
};

class CNeighbourDefaultSensor : public CSimulatedSensor, public CCI_NeighbourSensor
{
public:
  void SetRobot(CComposableEntity& robot) override
  {
    id_ = robot.GetId();
    body_ = &robot.GetComponent<CEmbodiedEntity>("body");
    robot.GetComponent<CControllableEntity>("controller").AddCheckedRay(false, CRay3());
    body_->GetOriginAnchor().Enable();
  }
  void Init(TConfigurationNode& node) override
  {
    CCI_NeighbourSensor::Init(node);
    GetNodeAttribute(node, "range", range_);
    if (range_ <= 0) THROW_ARGOSEXCEPTION("the range is " << range_);
    noise_ = CRandom::CreateRNG("argos");
  }
  void Update() override
  {
    if (IsDisabled()) return;
    nearest_ = 0;
    const CVector3& place = body_->GetOriginAnchor().Position;
    for (auto& robot : CSimulator::GetInstance().GetSpace().GetEntitiesByType("foot-bot"))
    {
      auto& other = *any_cast<CFootBotEntity*>(robot.second);
      const Real distance = Distance(other.GetEmbodiedEntity().GetOriginAnchor().Position, place);
      if (other.GetId() != id_ && distance <= range_ && (nearest_ == 0 || distance < nearest_)) nearest_ = distance;
    }
    CVector3 ahead(range_, 0, 0);
    ahead.Rotate(body_->GetOriginAnchor().Orientation);
    const CVector3 eye = place + CVector3(0, 0, 0.05);
    SEmbodiedEntityIntersectionItem met;
    ahead_ = GetClosestEmbodiedEntityIntersectedByRay(met, CRay3(eye, eye + ahead), *body_) ? met.TOnRay * range_ : 0;
    noise_->Uniform(CRange<Real>(0, 1));
  }
  void Reset() override { nearest_ = 0; }

private:
  std::string id_;
  CEmbodiedEntity* body_ = nullptr;
  Real range_ = 0;
  CRandom::CRNG* noise_ = nullptr;
};

class CNeighbourBlindSensor : public CSimulatedSensor, public CCI_NeighbourSensor
{
public:
  void SetRobot(CComposableEntity&) override {}
  void Update() override { nearest_ = -1; }
};

class CCI_LampActuator : public CCI_Actuator
{
public:
  void SetColor(const CColor& colour) { colour_ = colour; }

protected:
  CColor colour_ = CColor::BLACK;
};

class CLampDefaultActuator : public CSimulatedActuator, public CCI_LampActuator
{
public:
  void SetRobot(CComposableEntity& robot) override { leds_ = &robot.GetComponent<CLEDEquippedEntity>("leds"); }
  void Update() override { leds_->SetAllLEDsColors(colour_); }
  void Reset() override { colour_ = CColor::BLACK; }

private:
  CLEDEquippedEntity* leds_ = nullptr;
};

REGISTER_SENSOR(CNeighbourDefaultSensor, "neighbour", "default", "A user [user@example.org]", "1.0", "Sees robots.",
                "Sees the nearest robot.\n", "Usable");
REGISTER_SENSOR(CNeighbourBlindSensor, "neighbour", "blind", "A user [user@example.org]", "1.0", "Sees no robots.",
                "Sees no robots.\n", "Usable");
REGISTER_ACTUATOR(CLampDefaultActuator, "lamp", "default", "A user [user@example.org]", "1.0", "Lights up.",
                  "Lights all LEDs.\n", "Usable");

}  // namespace argos

using namespace argos;

// Says what its sensors read, lights its lamp in the second step, and drives ahead if `speed` says so.
class CSenser : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    GetNodeAttributeOrDefault(node, "speed", speed_, speed_);
    GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera")->Enable();
  }
  void ControlStep() override
  {
    ++step_;
    const auto* neighbour = GetSensor<CCI_NeighbourSensor>("neighbour");
    const auto& blobs =
        GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera")->GetReadings();
    LOG << "step " << step_ << " nearest " << neighbour->GetNearest() << " ahead " << neighbour->GetAhead() << " blobs "
        << blobs.BlobList.size() << std::endl;
    if (step_ == 2) GetActuator<CCI_LampActuator>("lamp")->SetColor(CColor::RED);
    GetActuator<CCI_DifferentialSteeringActuator>("differential_steering")->SetLinearVelocity(speed_, speed_);
  }

private:
  Real speed_ = 0;  // cm/s
  int step_ = 0;
};

REGISTER_CONTROLLER(CSenser, "senser")
