// What controllers log has the robot and the tick beside it.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/control_interface/ci_controller.h"
#include "common/logging/log.h"
#include "controller_host/controller_host.h"

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
  Experiment experiment;
  experiment.arena_size = {10, 10, 2};
  experiment.controllers.resize(1);
  experiment.controllers[0].tag = "controller_log_test";
  experiment.controllers[0].id = "logger";
  experiment.engines.resize(1);
  EntityConfiguration& entity = experiment.entities.emplace_back();
  entity.kind = EntityKind::kFootbot;
  entity.id = "fb_7";
  entity.controller = "logger";
  entity.movable = true;
  entity.pose.position = {1, 1, 0};
  experiment.engines[0].entities.push_back(0);

  const std::filesystem::path folder = testing::TempDir() + "controller_log_" + std::to_string(getpid());
  std::filesystem::create_directories(folder);
  OpenLog({.process = "host", .folder = folder.string()});
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  ControllerHost host(space, assignment, 0);
  space.SetTick(12);
  host.Tick({});
  OpenLog({.process = "test"});  // closes the file
  std::ifstream file(folder / "host.log");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_THAT(text, testing::HasSubstr("robot 'fb_7' at tick 0: ready\n"));
  EXPECT_THAT(text, testing::HasSubstr("robot 'fb_7' at tick 12: sees {} walls\n"));
  std::filesystem::remove_all(folder);
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
