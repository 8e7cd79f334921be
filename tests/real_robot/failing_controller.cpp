// Fails in the step that its parameter names.
#include <stdexcept>

#include "ci_controller.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CFailingController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    step_ = static_cast<std::uint64_t>(t_tree.GetInteger("step", 0));
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    if (GetRobot()->GetTick() == step_) throw std::runtime_error("the floor is wet");
    wheels_->SetFootBotWheelsAngularVelocity(1, 1);
  }

private:
  std::uint64_t step_ = 0;
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
};

REGISTER_CONTROLLER(CFailingController, "failing_controller")
