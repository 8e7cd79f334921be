// A controller that fails in the way and at the tick that its parameters say, for tests of how failures are reported.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "ci_controller.h"

class CFaultyController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    fault_ = t_tree.GetText("fault", "none");
    tick_ = static_cast<std::uint64_t>(t_tree.GetInteger("tick", 0));
    if (fault_ == "init_throws") throw std::runtime_error("cannot begin");
    return fault_ == "init_fails" ? RETURN_ERROR : RETURN_OK;
  }

  void ControlStep() override
  {
    if (GetRobot()->GetTick() < tick_) return;
    if (fault_ == "step_throws") throw std::runtime_error("cannot go on");
    if (fault_ == "step_crashes") std::abort();
    if (fault_ == "step_exits") std::exit(0);
    while (fault_ == "step_hangs") std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

private:
  std::string fault_;
  std::uint64_t tick_ = 0;
};

REGISTER_CONTROLLER(CFaultyController, "faulty_controller")
