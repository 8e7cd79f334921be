// Reading the sensors of a tick before its step changes nothing for the controllers.
#include <gtest/gtest.h>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_radio.h"
#include "controller_host/controller_host.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

// Sends a packet in each step, and counts the packets that it receives.
class Talker : public CCI_Controller
{
public:
  static inline std::size_t heard = 0;

  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    heard += GetRobot()->Sensor<CCI_RadioSensor>("radio").GetAllPackets().size();
    GetRobot()->Actuator<CCI_RadioActuator>("radio").Send(std::array<std::uint8_t, 1>{7});
  }
};

REGISTER_CONTROLLER(Talker, "sense_once_test")

// How many packets two robots hear in ten ticks.
std::size_t Heard(bool look)
{
  RegisterBuiltinDevices();
  const Experiment experiment = test::RobotsOf("sense_once_test", {"a", "b"}, {"generic_radio"}, {"generic_radio"});
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  ControllerHost host(space, assignment, 0);
  Talker::heard = 0;
  for (std::uint64_t tick = 0; tick < 10; ++tick)
  {
    space.SetTick(tick);
    if (look) host.Sense({});
    const ControlCommands& commands = host.Tick({});
    for (std::size_t k = 0; k < commands.attributes.slots.size(); ++k)
      space.SetAttribute(commands.attributes.slots[k], commands.attributes.values[k]);
  }
  return Talker::heard;
}

TEST(SenseOnce, PacketsOfATickAreHeardInItsStep)
{
  EXPECT_EQ(Heard(false), 2 * 9U);
  EXPECT_EQ(Heard(true), 2 * 9U);
}

}  // namespace
}  // namespace swarmanoid
