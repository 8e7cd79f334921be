#include "ci_controller.h"

// Takes the name of another controller.
class CSameNameController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};

REGISTER_CONTROLLER(CSameNameController, "good_controller")
