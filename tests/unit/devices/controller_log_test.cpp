// Log lines of controllers have the robot and the tick.
#include <gmock/gmock.h>

#include "common/control_interface/ci_controller.h"
#include "common/logging/log.h"
#include "controller_host/controller_host.h"
#include "tests/world/small_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

class Logger : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override
  {
    GetRobot()->Log("ready");
    return RETURN_OK;
  }
  void ControlStep() override { GetRobot()->Log("sees {} walls"); }
};
REGISTER_CONTROLLER(Logger, "controller_log_test")

TEST(ControllerLog, NamesRobotAndTick)
{
  const Experiment experiment = test::RobotsOf("controller_log_test", {"fb_7"});
  const test::TemporaryFolder folder;
  OpenLog({.process = "host", .folder = folder.Path()});
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  ControllerHost host(space, assignment, 0);
  space.SetTick(12);
  host.Tick({});
  OpenLog({.process = "test"});  // closes the file
  const std::string text = folder.Read("host.log");
  EXPECT_THAT(text, testing::HasSubstr("robot 'fb_7' at tick 0: ready\n"));
  EXPECT_THAT(text, testing::HasSubstr("robot 'fb_7' at tick 12: sees {} walls\n"));
}

TEST(ControllerLog, GoesToStandardErrorWithoutARuntime)
{
  CCI_Robot robot("fb", "footbot");
  testing::internal::CaptureStderr();
  robot.Log("alone");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "robot 'fb' at tick 0: alone\n");
}

}  // namespace
}  // namespace swarmanoid
