// A controller host checks the commands of its controllers: NaN is a mistake of the controller.
#include <gmock/gmock.h>

#include <functional>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_propellers_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_head_actuator.h"
#include "common/control_interface/handbot/ci_handbot_rope_actuator.h"
#include "common/space/attributes.h"
#include "controller_host/controller_host.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;

const double kNan = __builtin_nan("");

// Does what the test sets, with each robot of its kind.
class Commander : public CCI_Controller
{
public:
  static inline std::function<void(CCI_Robot& robot)> command;
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override { command(*GetRobot()); }
};

REGISTER_CONTROLLER(Commander, "commands_test")

// An actuator of a user that sets an attribute of some entity.
class Painter : public ActuatorBatch
{
public:
  static inline AttributeChanges changes;
  void Init(const DeviceSetup& setup) override { devices_.resize(setup.robots.size()); }
  CCI_Actuator* Actuator(std::size_t k) override { return &devices_[k]; }
  void Commit(const ChannelView&, AttributeChanges& all) override
  {
    for (std::size_t k = 0; k < changes.slots.size(); ++k) all.Add(changes.slots[k], changes.values[k]);
  }

private:
  std::vector<CCI_Actuator> devices_;
};

REGISTER_ACTUATOR(Painter, {.label = "commands_test_paint", .implementation = "painter"})

// Returns an experiment with two robots of a kind that have these actuators, by type and implementation.
Experiment TwoRobots(EntityKind kind, const std::vector<std::pair<std::string, std::string>>& actuators)
{
  RegisterBuiltinDevices();
  Experiment experiment = test::RobotsOf("commands_test", {"robot_0", "robot_1"}, {}, {}, kind);
  for (const auto& [type, implementation] : actuators)
  {
    DeviceConfiguration& device = experiment.controllers[0].actuators.emplace_back();
    device.type = type;
    device.implementation = implementation;
  }
  return experiment;
}

// Returns the error message if the second robot does `command` at tick 5.
std::string Mistake(EntityKind kind, const std::vector<std::pair<std::string, std::string>>& actuators,
                    const std::function<void(CCI_Robot& robot)>& command)
{
  const Experiment experiment = TwoRobots(kind, actuators);
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  space.SetTick(5);
  ControllerHost host(space, assignment, 0);
  Commander::command = [&](CCI_Robot& robot)
  {
    if (robot.GetId() == "robot_1") command(robot);
  };
  return test::MessageOf<ActivityError>([&] { host.Tick({}); });
}

std::string NoNumber(const std::string& device)
{
  return "robot 'robot_1': its controller 'c' commanded nan to the actuator '" + device +
         "' at tick 5; commands must be finite numbers";
}

TEST(Commands, WhatIsNoNumberIsToldWithRobotDeviceAndTick)
{
  const auto footbot = [](const char* type, const char* implementation, const auto& command) {
    return Mistake(EntityKind::kFootbot, {{type, implementation}}, command);
  };
  for (const char* wheels : {"dummy_footbot_wheels", "noisy_footbot_wheels", "pid_footbot_wheels"})
    EXPECT_EQ(
        footbot("footbot_wheels", wheels,
                [](CCI_Robot& robot) {
                  robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels").SetFootBotWheelsAngularVelocity(1, kNan);
                }),
        NoNumber("footbot_wheels"));
  EXPECT_EQ(footbot("footbot_turret", "dummy_footbot_turret",
                    [](CCI_Robot& robot)
                    { robot.Actuator<CCI_FootBotTurretActuator>("footbot_turret").SetTurretAngularVelocity(kNan); }),
            NoNumber("footbot_turret"));
  EXPECT_EQ(
      footbot("footbot_gripper", "dummy_footbot_gripper",
              [](CCI_Robot& robot) { robot.Actuator<CCI_FootBotGripperActuator>("footbot_gripper").SetGripper(kNan); }),
      NoNumber("footbot_gripper"));
  EXPECT_THAT(footbot("footbot_preferential_direction", "led_ring_preferential_direction",
                      [](CCI_Robot& robot)
                      {
                        robot.Actuator<CCI_FootBotPreferentialDirectionActuator>("footbot_preferential_direction")
                            .SetDirection(kNan, 0xff0000);
                      }),
              AllOf(HasSubstr("robot 'robot_1'"), HasSubstr("tick 5"), HasSubstr("footbot_preferential_direction"),
                    HasSubstr("nan")));
}

TEST(Commands, FlightAndLaserToo)
{
  const auto eyebot = [](const char* type, const char* implementation, const auto& command) {
    return Mistake(EntityKind::kEyebot, {{type, implementation}}, command);
  };
  const auto fly = [](CCI_Robot& robot)
  { robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers").SetVelocity(0, 0, kNan, 0); };
  const auto go = [](CCI_Robot& robot) {
    robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers").SetPosition({1, 2, 3}, kNan);
  };
  EXPECT_EQ(eyebot("eyebot_propellers", "dummy_eyebot_propellers", fly), NoNumber("eyebot_propellers"));
  EXPECT_EQ(eyebot("eyebot_propellers", "position_eyebot_propellers", fly), NoNumber("eyebot_propellers"));
  EXPECT_EQ(eyebot("eyebot_propellers", "position_eyebot_propellers", go), NoNumber("eyebot_propellers"));
  EXPECT_EQ(
      eyebot("eyebot_laser", "generic_eyebot_laser",
             [](CCI_Robot& robot) { robot.Actuator<CCI_EyeBotLaserActuator>("eyebot_laser").SetDirection(kNan, 0); }),
      NoNumber("eyebot_laser"));
}

// Head and arms share a channel.
TEST(Commands, OfTwoDevicesOnOneChannelTheRightOneIsNamed)
{
  const auto handbot = [](const auto& command)
  {
    return Mistake(EntityKind::kHandbot,
                   {{"handbot_head", "dummy_handbot_head"},
                    {"handbot_arms", "dummy_handbot_arms"},
                    {"handbot_rope", "dummy_handbot_rope"}},
                   command);
  };
  EXPECT_EQ(handbot([](CCI_Robot& robot)
                    { robot.Actuator<CCI_HandBotHeadActuator>("handbot_head").SetHeadAngularVelocity(kNan); }),
            NoNumber("handbot_head"));
  EXPECT_EQ(handbot([](CCI_Robot& robot)
                    { robot.Actuator<CCI_HandBotArmsActuator>("handbot_arms").SetWristVelocities(0, kNan); }),
            NoNumber("handbot_arms"));
  EXPECT_EQ(
      handbot([](CCI_Robot& robot) { robot.Actuator<CCI_HandBotRopeActuator>("handbot_rope").SetWinchVelocity(kNan); }),
      NoNumber("handbot_rope"));
}

TEST(Commands, WhatIsBeyondALimitIsStillCut)
{
  EXPECT_EQ(Mistake(EntityKind::kFootbot, {{"footbot_wheels", "dummy_footbot_wheels"}},
                    [](CCI_Robot& robot)
                    {
                      robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels")
                          .SetFootBotWheelsAngularVelocity(1e300, -__builtin_inf());
                    }),
            "");
}

TEST(Commands, AttributesOfADeviceAreChecked)
{
  const auto paint = [](std::uint32_t slot, double value)
  {
    Painter::changes.Clear();
    Painter::changes.Add(slot, value);
    return Mistake(EntityKind::kFootbot, {{"commands_test_paint", "painter"}}, [](CCI_Robot&) {});
  };
  const auto slots = static_cast<std::uint32_t>(AttributeCount(EntityKind::kFootbot));
  EXPECT_EQ(paint(3, 0xff0000), "");
  EXPECT_EQ(paint(slots + 3, kNan), NoNumber("commands_test_paint"));
  EXPECT_THAT(paint(3, 0.5), AllOf(HasSubstr("actuator 'commands_test_paint' (painter) at tick 5: "),
                                   HasSubstr("the attribute 'led' 3 of the footbot 'robot_0' is 0.5")));
  EXPECT_THAT(paint(0x7ffffff0, 1), HasSubstr("there is no attribute slot 2147483632"));
  EXPECT_THAT(paint(2 * slots + 1, 0), HasSubstr("the presence of the footbot 'robot_1' is 0"));
}

}  // namespace
}  // namespace swarmanoid
