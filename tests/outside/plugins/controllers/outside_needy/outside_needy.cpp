// Needs the parameter 'speed'; "exit" as its value ends the program in Init, "crash" kills it.
#include <csignal>
#include <cstdlib>

#include "ci_controller.h"

class COutsideNeedy : public CCI_Controller
{
public:
  int Init(const TConfigurationTree configuration) override
  {
    if (configuration.GetText("speed", "") == "exit") std::exit(0);
    if (configuration.GetText("speed", "") == "crash") std::raise(SIGSEGV);
    configuration.GetNumber("speed");
    return RETURN_OK;
  }
  void ControlStep() override {}
  bool HasState() const override { return true; }
};

REGISTER_CONTROLLER(COutsideNeedy, "outside_needy")
