// Loop functions that run trials one after another by resetting the run, as searches for the best parameters do.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

using namespace argos;

// Drives by a random number, and counts its steps.
class CTried : public CCI_Controller
{
public:
  void Init(TConfigurationNode&) override
  {
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    leds_ = GetActuator<CCI_LEDsActuator>("leds");
    radio_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    random_ = CRandom::CreateRNG("argos");
  }
  void Reset() override
  {
    steps_ = 0;
    ++resets_;
  }
  void ControlStep() override
  {
    ++steps_;
    drawn_ = random_->Uniform(CRange<Real>(5, 10));
    wheels_->SetLinearVelocity(drawn_, 10);
    if (steps_ == 2) leds_->SetAllColors(CColor::RED);
    radio_->SetData(0, static_cast<UInt8>(steps_));
  }
  int steps_ = 0;
  int resets_ = 0;
  Real drawn_ = 0;

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  CCI_LEDsActuator* leds_ = nullptr;
  CCI_RangeAndBearingActuator* radio_ = nullptr;
  CRandom::CRNG* random_ = nullptr;
};

class CRepeater : public CLoopFunctions
{
public:
  void Init(TConfigurationNode& node) override
  {
    GetNodeAttribute(node, "trials", trials_);
    GetNodeAttributeOrDefault(node, "where", where_, where_);
    file_.open("trials.tsv");
    added_ = new CFootBotEntity("late", "t", CVector3(-1, -1, 0));
    AddEntity(*added_);
  }
  void Reset() override
  {
    ++resets_;
    Tell("reset");
  }
  void PreStep() override { Tell("pre"); }
  void PostStep() override
  {
    const UInt32 clock = GetSpace().GetSimulationClock();
    Tell("post");
    if (clock == 3)
    {
      MoveEntity(Can().GetEmbodiedEntity(), CVector3(1, 1, 0), CQuaternion());
      Can().GetLEDEquippedEntity().SetAllLEDsColors(CColor::BLUE);
      Lamp().SetColor(CColor::RED);
      if (resets_ == 0) RemoveEntity("gone");
    }
    if (where_ == "post" && clock == 6 && trial_ + 1 < trials_) Again();
  }
  bool IsExperimentFinished() override
  {
    if (where_ != "finished" || GetSpace().GetSimulationClock() < 6 || trial_ + 1 == trials_) return false;
    Again();
    return false;
  }

private:
  void Again()
  {
    ++trial_;
    // The third trial differs from the others.
    if (trial_ == 2)
      GetSimulator().Reset(99);
    else
      GetSimulator().Reset();
  }
  CCylinderEntity& Can() { return *any_cast<CCylinderEntity*>(GetSpace().GetEntitiesByType("cylinder")["can"]); }
  CLightEntity& Lamp() { return *any_cast<CLightEntity*>(GetSpace().GetEntitiesByType("light")["lamp"]); }
  void Tell(const char* when)
  {
    auto& robot = dynamic_cast<CFootBotEntity&>(GetSpace().GetEntity("fb"));
    const auto& controller = dynamic_cast<const CTried&>(robot.GetControllableEntity().GetController());
    file_ << trial_ << '\t' << when << '\t' << GetSpace().GetSimulationClock() << '\t'
          << robot.GetEmbodiedEntity().GetOriginAnchor().Position.GetX() << '\t' << controller.steps_ << '\t'
          << controller.resets_ << '\t' << controller.drawn_ << '\t' << resets_ << '\t'
          << Can().GetEmbodiedEntity().GetOriginAnchor().Position.GetX() << '\t'
          << Can().GetLEDEquippedEntity().GetLED(0).GetColor() << '\t' << Lamp().GetColor() << '\t'
          << robot.GetLEDEquippedEntity().GetLED(0).GetColor() << '\t'
          << static_cast<int>(robot.GetRABEquippedEntity().GetData()[0]) << '\t'
          << added_->GetEmbodiedEntity().GetOriginAnchor().Position.GetX() << '\t'
          << GetSpace().GetEntitiesByType("foot-bot").size() << '\n';
  }

  UInt32 trials_ = 1;
  UInt32 trial_ = 0;
  int resets_ = 0;
  std::string where_ = "post";
  std::ofstream file_;
  CFootBotEntity* added_ = nullptr;
};

// Resets without reading any robot.
class CBlind : public CLoopFunctions
{
public:
  void PostStep() override
  {
    if (GetSpace().GetSimulationClock() == 2) GetSpace().Reset();
  }
};

REGISTER_CONTROLLER(CTried, "tried")
REGISTER_LOOP_FUNCTIONS(CRepeater, "repeater")
REGISTER_LOOP_FUNCTIONS(CBlind, "blind")
