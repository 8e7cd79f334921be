// A controller without devices that does nothing. It shows that the user's plug-ins are loaded at all.
#include "ci_controller.h"

class COutsideStill : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};

REGISTER_CONTROLLER(COutsideStill, "outside_still")
