// A controller that fails by OUTSIDE_FAULT.
#include "controllers/outside_faults/faults.h"

#include "ci_controller.h"

class COutsideFaults : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override { faults::FailIfAsked("controller", GetRobot()->GetTick()); }
};

REGISTER_CONTROLLER(COutsideFaults, "outside_faults")
