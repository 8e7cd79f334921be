// Loop functions that make robots which the experiment file does not declare, and look at what they have made.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/utility/math/ray3.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

using namespace argos;

// Drives straight on and counts what it sees of each colour.
class CMade : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    camera_ = GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera");
    camera_->Enable();
    GetNodeAttribute(node, "velocity", velocity_);
    LOG << "Init of " << GetId() << std::endl;
  }
  void ControlStep() override
  {
    ++steps_;
    wheels_->SetLinearVelocity(velocity_, velocity_);
    red_ = blue_ = 0;
    for (const auto* blob : camera_->GetReadings().BlobList)
    {
      red_ += blob->Color == CColor::RED;
      blue_ += blob->Color == CColor::BLUE;
    }
  }
  void Destroy() override { LOG << "Destroy of " << GetId() << std::endl; }
  int Steps() const { return steps_; }
  int Red() const { return red_; }
  int Blue() const { return blue_; }

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_ColoredBlobOmnidirectionalCameraSensor* camera_ = nullptr;
  Real velocity_ = 0;
  int steps_ = 0;
  int red_ = 0;
  int blue_ = 0;
};

class CMaker : public CLoopFunctions
{
public:
  CMaker() : ticks_a_second_(GetSimulator().GetPhysicsEngine("dyn2d").GetInverseSimulationClockTick()) {}

  void Init(TConfigurationNode& node) override
  {
    UInt32 robots = 0;
    GetNodeAttribute(node, "robots", robots);
    file_.open("made.tsv");
    for (UInt32 i = 0; i < robots; ++i) made_.push_back(new CFootBotEntity("made" + std::to_string(i), "m"));
    // Two controllers before all robots, in another order.
    const CMade* controllers[] = {&ControllerOf(*made_[2]), &ControllerOf(*made_[1])};
    // All where the first one stays, and from there to their places.
    for (UInt32 i = 0; i < robots; ++i)
    {
      AddEntity(*made_[i]);
      if ((i == 1 || i == 2) && controllers[2 - i] != &ControllerOf(*made_[i]))
        THROW_ARGOSEXCEPTION("another controller for " << i);
      if (i > 0 && !MoveEntity(made_[i]->GetEmbodiedEntity(), CVector3(0, 0.5 * i, 0), CQuaternion()))
        THROW_ARGOSEXCEPTION("no place for " << i);
    }
    file_ << "# " << GetSpace().GetEntitiesByType("foot-bot").size() << " " << ControllerOf(*made_[0]).GetId() << " "
          << made_[1]->GetEmbodiedEntity().MoveTo(CVector3(0, 0, 0), CQuaternion()) << " "
          << GetSpace().GetArenaLimits().GetMax() << " " << ticks_a_second_ << "\n";
  }
  void PostStep() override
  {
    const UInt32 clock = GetSpace().GetSimulationClock();
    CCylinderEntity& can = Can();
    const CFootBotEntity& first = *made_[0];
    const CMade& controller = ControllerOf(first);
    file_ << clock << '\t' << GetSpace().GetEntitiesByType("foot-bot").size() << '\t'
          << first.GetEmbodiedEntity().GetOriginAnchor().Position.GetX() << '\t' << controller.Steps() << '\t'
          << controller.Red() << '\t' << controller.Blue() << '\t' << can.GetLEDEquippedEntity().GetLED(0).GetColor();
    if (clock == 3) RemoveEntity("made1");
    // It is far from the camera, but for one step.
    if (clock == 2)
    {
      light_ = new CLightEntity("lamp", CVector3(1.5, 1.5, 0.1), CColor::BLUE, 1.0);
      light_->SetMedium(GetSimulator().GetMedium<CLEDMedium>("leds"));
      AddEntity(*light_);
    }
    if (clock == 3) MoveEntity(*light_, CVector3(0.3, 0.2, 0.1), CQuaternion());
    if (clock == 4) RemoveEntity("lamp");
    if (clock == 5) can.GetLEDEquippedEntity().SetAllLEDsColors(CColor::BLUE);
    if (clock == 6)
    {
      made_.push_back(new CFootBotEntity("late", "m", CVector3(-0.5, 0.5, 0)));
      AddEntity(*made_.back());
      file_ << '\t' << ControllerOf(*made_.back()).Steps();
    }
    file_ << '\n';
  }

  void PostExperiment() override
  {
    Can().GetLEDEquippedEntity().SetAllLEDsColors(CColor::GREEN);
    file_ << "# over " << Can().GetLEDEquippedEntity().GetLED(0).GetColor() << "\n";
  }

private:
  CCylinderEntity& Can() { return *any_cast<CCylinderEntity*>(GetSpace().GetEntitiesByType("cylinder")["can"]); }
  static const CMade& ControllerOf(const CFootBotEntity& robot)
  {
    return dynamic_cast<const CMade&>(robot.GetControllableEntity().GetController());
  }

  Real ticks_a_second_;
  CLightEntity* light_ = nullptr;
  std::ofstream file_;
  std::vector<CFootBotEntity*> made_;
};

REGISTER_CONTROLLER(CMade, "made")
REGISTER_LOOP_FUNCTIONS(CMaker, "maker")
