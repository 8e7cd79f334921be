#include "ci_controller.h"

class CGoodController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};

REGISTER_CONTROLLER(CGoodController, "good_controller")
