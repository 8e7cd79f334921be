// A controller that declares its parameters: it drives straight on.
#include "ci_controller.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class COutsideWalker : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    velocity_ = t_tree.GetNumber("velocity") * (t_tree.GetBoolean("backwards") ? -1 : 1);
    return RETURN_OK;
  }
  void ControlStep() override { wheels_->SetFootBotWheelsLinearVelocity(velocity_, velocity_); }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  double velocity_ = 0;
};

REGISTER_CONTROLLER(COutsideWalker, {.label = "outside_walker",
                                     .brief = "drives straight on",
                                     .parameters = {{.name = "velocity",
                                                     .unit = "m/s",
                                                     .default_value = "0.1",
                                                     .description = "Of both wheels.",
                                                     .minimum = 0,
                                                     .maximum = 0.3},
                                                    {.name = "backwards",
                                                     .type = ParameterType::kBoolean,
                                                     .default_value = "no",
                                                     .description = "Whether it drives backwards."},
                                                    {.name = "target_distance",
                                                     .unit = "m",
                                                     .default_value = "1",
                                                     .description = "Where it would stop.",
                                                     .minimum = 0}}})
