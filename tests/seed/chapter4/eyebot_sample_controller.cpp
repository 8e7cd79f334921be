// The controller that the eyebot of the listing of <arena> names.
#include "ci_controller.h"

class CEyebotSampleController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};

REGISTER_CONTROLLER(CEyebotSampleController, "eyebot_sample_controller")
