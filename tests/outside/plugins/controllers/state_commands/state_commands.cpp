// A controller that commands NaN at tick 5; the parameter names the actuator.
#include <limits>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"

class CStateCommands : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    actuator_ = t_tree.GetText("actuator", "");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    using namespace swarmanoid;
    if (++steps_ != 6) return;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    if (actuator_ == "footbot_wheels")
      GetRobot()->Actuator<CCI_FootBotWheelsActuator>(actuator_).SetFootBotWheelsAngularVelocity(1, kNan);
    if (actuator_ == "footbot_turret")
      GetRobot()->Actuator<CCI_FootBotTurretActuator>(actuator_).SetTurretAngularVelocity(kNan);
    if (actuator_ == "footbot_gripper") GetRobot()->Actuator<CCI_FootBotGripperActuator>(actuator_).SetGripper(kNan);
    if (actuator_ == "footbot_preferential_direction")
      GetRobot()->Actuator<CCI_FootBotPreferentialDirectionActuator>(actuator_).SetDirection(kNan, 0xff0000);
  }

private:
  std::string actuator_;
  int steps_ = 0;
};

REGISTER_CONTROLLER(CStateCommands, "state_commands")
