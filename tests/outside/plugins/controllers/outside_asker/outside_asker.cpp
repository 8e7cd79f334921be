// Controllers of the first form, which declare nothing: one asks for its parameters in Init, the other when it needs
// them.
#include "ci_controller.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class COutsideAsker : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    velocity_ = t_tree.GetNumber("velocity", 0.1) * t_tree.Child("gains").GetNumber("forward", 1);
    return RETURN_OK;
  }
  void ControlStep() override { wheels_->SetFootBotWheelsLinearVelocity(velocity_, velocity_); }

private:
  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  double velocity_ = 0;
};

class COutsideLater : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    tree_ = t_tree;
    return RETURN_OK;
  }
  void ControlStep() override
  {
    const double velocity = tree_.GetNumber("velocity", 0.1);
    GetRobot()
        ->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels")
        .SetFootBotWheelsLinearVelocity(velocity, velocity);
  }
  bool ReadsParametersLater() const override { return true; }

private:
  TConfigurationTree tree_;
};

REGISTER_CONTROLLER(COutsideAsker, "outside_asker")
REGISTER_CONTROLLER(COutsideLater, "outside_later", "asks for its parameters when it needs them")
