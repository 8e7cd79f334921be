// Loop functions that charge a battery.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/battery_equipped_entity.h>

using namespace argos;

class CCharger : public CLoopFunctions
{
public:
  void PostStep() override
  {
    auto& robot = *any_cast<CFootBotEntity*>(GetSpace().GetEntitiesByType("foot-bot")["moving"]);
    CBatteryEquippedEntity& battery = robot.GetBatterySensorEquippedEntity();
    LOG << "step " << GetSpace().GetSimulationClock() << ": " << battery.GetAvailableCharge() << " of "
        << battery.GetFullCharge() << std::endl;
    if (GetSpace().GetSimulationClock() == 50) battery.SetAvailableCharge(battery.GetFullCharge());
  }
};

REGISTER_LOOP_FUNCTIONS(CCharger, "charger")
