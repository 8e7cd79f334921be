// A controller that fails in the way and at the tick that its parameters say, for tests of how failures are reported.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
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
    mark_ = t_tree.GetText("mark", "");
    if (fault_ == "init_throws") throw std::runtime_error("cannot begin");
    return fault_ == "init_fails" ? RETURN_ERROR : RETURN_OK;
  }

  void ControlStep() override
  {
    if (GetRobot()->GetTick() < tick_) return;
    if (fault_ == "step_killed_once") DieOnce();
    if (fault_ == "step_throws") throw std::runtime_error("cannot go on");
    if (fault_ == "step_crashes") std::abort();
    if (fault_ == "step_exits") std::exit(0);
    while (fault_ == "step_hangs") std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  void Destroy() override
  {
    if (fault_ == "destroy_killed_once") DieOnce();
    if (fault_ == "destroy_crashes") std::abort();
  }

private:
  void DieOnce() const
  {
    if (std::ifstream(mark_)) return;
    std::ofstream(mark_).flush();
    raise(SIGKILL);
  }

  std::string fault_;
  std::string mark_;  // a file: it is there once the controller was killed
  std::uint64_t tick_ = 0;
};

REGISTER_CONTROLLER(CFaultyController, "faulty_controller")
