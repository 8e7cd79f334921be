// Linked with -ffast-math: GCC before 13 adds code that runs when the library is loaded and makes tiny numbers 0.
#include "ci_controller.h"

class CFastMathController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};

REGISTER_CONTROLLER(CFastMathController, "fast_math_controller")
