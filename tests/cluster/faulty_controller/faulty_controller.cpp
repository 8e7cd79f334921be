// A controller that fails in the way and at the tick of its parameters, for tests of failure reports.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "ci_controller.h"
#include "ci_led_ring_actuator.h"
#include "ci_wheels_actuator.h"

class CFaultyController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    fault_ = t_tree.GetText("fault", "none");
    tick_ = static_cast<std::uint64_t>(t_tree.GetInteger("tick", 0));
    mark_ = t_tree.GetText("mark", "");
    if (t_tree.GetInteger("drives", 0) != 0)
    {
      wheels_ = &GetRobot()->Actuator<CCI_WheelsActuator>("wheels");
      leds_ = &GetRobot()->Actuator<CCI_LedRingActuator>("led_ring");
    }
    if (fault_ == "init_throws") throw std::runtime_error("cannot begin");
    return fault_ == "init_fails" ? RETURN_ERROR : RETURN_OK;
  }

  void ControlStep() override
  {
    // Steps of this process; the first one begins with the run.
    ++steps_;
    if (wheels_ != nullptr)
    {
      wheels_->SetLinearVelocity(0.1, 0.1 + 1e-4 * static_cast<double>(steps_));
      leds_->SetAllColours(0xff0000);
    }
    if (fault_ == "life_throws" && steps_ > tick_) throw std::runtime_error("cannot go on");
    if (GetRobot()->GetTick() < tick_) return;
    if (fault_ == "step_killed_once") DieOnce();
    if (fault_ == "step_throws") throw std::runtime_error("cannot go on");
    if (fault_ == "step_crashes") std::abort();
    if (fault_ == "step_exits") std::exit(0);
    if (fault_ == "step_spins") Spin();
    if (fault_ == "step_spins_once" && MarkOnce()) Spin();
    while (fault_ == "step_hangs") std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  bool HasState() const override { return wheels_ != nullptr; }
  void SaveState(std::ostream& state) const override { state << steps_; }
  void LoadState(std::istream& state) override { state >> steps_; }

  void Destroy() override
  {
    if (fault_ == "destroy_killed_once") DieOnce();
    if (fault_ == "destroy_crashes") std::abort();
  }

private:
  // Works for 300 ms of processor time.
  static void Spin()
  {
    const std::clock_t end = std::clock() + 3 * CLOCKS_PER_SEC / 10;
    while (std::clock() < end) continue;
  }

  // Returns true for the first caller in the run.
  bool MarkOnce() const
  {
    if (std::ifstream(mark_)) return false;
    std::ofstream(mark_).flush();
    return true;
  }
  void DieOnce() const
  {
    if (MarkOnce()) raise(SIGKILL);
  }

  std::string fault_;
  std::string mark_;  // a file: it exists once the controller has done the action that is done once
  std::uint64_t tick_ = 0;
  std::uint64_t steps_ = 0;
  CCI_WheelsActuator* wheels_ = nullptr;
  CCI_LedRingActuator* leds_ = nullptr;
};

REGISTER_CONTROLLER(CFaultyController, "faulty_controller")
