// Loop functions that build an arena: walls, pillars and crates that the experiment file does not declare, with LEDs.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>

using namespace argos;

class CBuilder : public CLoopFunctions
{
public:
  void Init(TConfigurationNode& node) override
  {
    UInt32 late = 0;
    GetNodeAttribute(node, "late", late);
    late_ = late != 0;
    GetNodeAttributeOrDefault(node, "rests", rests_, rests_);
    UInt32 more = 0;
    GetNodeAttributeOrDefault(node, "more", more, more);
    const Real size = 0.001 * GetSimulator().GetRandomSeed();
    for (UInt32 i = 0; i < more; ++i)
      AddEntity(*new CBoxEntity("more" + std::to_string(i), CVector3(-1, -1 + 0.02 * i, 0), CQuaternion(), true,
                                CVector3(size, size, size)));
    CLEDMedium& leds = GetSimulator().GetMedium<CLEDMedium>("leds");
    // The wall is not turned: user code often writes zeros for that.
    AddEntity(*new CBoxEntity("wall", CVector3(0.6, 0, 0), CQuaternion(0, 0, 0, 0), false, CVector3(0.1, 2, 0.5)));
    crate_ = new CBoxEntity("crate", CVector3(0, 0.3, 0), CQuaternion(), true, CVector3(0.1, 0.1, 0.1), 1e12);
    AddEntity(*crate_);
    crate_->AddLED(CVector3(0, 0, 0.2), CColor::BLUE);
    crate_->EnableLEDs(leds);
    pillar_ = new CCylinderEntity("pillar", CVector3(), CQuaternion(), false, 0.05, 0.1);
    pillar_->GetLEDEquippedEntity().AddLED(CVector3(0, 0, 0.5), pillar_->GetEmbodiedEntity().GetOriginAnchor(),
                                           CColor::GREEN);
    pillar_->GetLEDEquippedEntity().AddToMedium(leds);
    pillar_->GetLEDEquippedEntity().Enable();
    pillar_->UpdateComponents();
    AddEntity(*pillar_);
    const CCylinderEntity copy = *pillar_;
    // From where it does not fit to where it does.
    file_.open("built.tsv");
    const bool in_the_wall = MoveEntity(pillar_->GetEmbodiedEntity(), CVector3(0.6, 0.5, 0), CQuaternion());
    const bool beside = MoveEntity(pillar_->GetEmbodiedEntity(), CVector3(0, -0.3, 0), CQuaternion());
    file_ << "# " << in_the_wall << beside << " " << GetSpace().GetEntitiesByType("box").size() << " "
          << GetSpace().GetEntitiesByType("cylinder").size() << " " << copy.GetRadius() << "\n";
  }
  void PostStep() override
  {
    const UInt32 clock = GetSpace().GetSimulationClock();
    auto& robot = *any_cast<CFootBotEntity*>(GetSpace().GetEntitiesByType("foot-bot")["fb"]);
    file_ << clock << '\t' << robot.GetEmbodiedEntity().GetOriginAnchor().Position.GetX() << '\t'
          << any_cast<CBoxEntity*>(GetSpace().GetEntitiesByType("box")["wall"])
                 ->GetEmbodiedEntity()
                 .GetOriginAnchor()
                 .Position
          << '\t' << crate_->GetEmbodiedEntity().IsMovable() << pillar_->GetEmbodiedEntity().IsMovable() << '\n';
    if (clock == 10) RemoveEntity("crate");
    if (clock == rests_) robot.Disable();
    if (clock == rests_ + 20) robot.SetEnabled(true);
    if (rests_ != 0 && robot.GetControllableEntity().IsEnabled() == (clock >= rests_ && clock < rests_ + 20))
      THROW_ARGOSEXCEPTION("the controller is not as the robot is");
    if (clock == 20)
      AddEntity(*new CBoxEntity("next", CVector3(-0.8, 0, 0), CQuaternion(), true, {0.1, 0.1, 0.1}, 1e12));
    if (clock == 30 && late_)
      AddEntity(*new CBoxEntity("other", CVector3(), CQuaternion(), true, {0.2, 0.2, 0.2}, 0.5));
  }

private:
  bool late_ = false;
  UInt32 rests_ = 0;
  CBoxEntity* crate_ = nullptr;
  CCylinderEntity* pillar_ = nullptr;
  std::ofstream file_;
};

REGISTER_LOOP_FUNCTIONS(CBuilder, "builder")
