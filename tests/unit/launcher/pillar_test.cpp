// Cylinders that do not move stop robots in every engine, and stay where they are.
#include <gtest/gtest.h>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

class CStraightOn : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels").SetFootBotWheelsLinearVelocity(0.2, 0.2);
  }
};
REGISTER_CONTROLLER(CStraightOn, "pillar_test")

TEST(Pillar, StopsRobotsAndStands)
{
  RegisterBuiltins();
  for (const std::string engine : {"kinematics2d", "dynamics2d", "dynamics3d"})
    for (const std::string movable : {"false", "true"})
    {
      const auto experiment =
          test::ExperimentText{
              .framework = "<maxclock>60</maxclock>",
              .controllers = test::Controller({.tag = "pillar_test", .actuators = {"dummy_footbot_wheels"}}),
              .size = "4,4,2",
              .arena =
                  "<footbot id='fb' position='1,2,0' controller='c'/><cylindric_prey id='pillar' "
                  "position='1.5,2,0' radius='0.1' height='0.2' mass='0.2' movable='" +
                  movable + "'/>",
              .engines = "<" + engine + " id='e'/>"}
              .Load();
      ASSERT_TRUE(experiment);
      CSimulator simulator(*experiment, {});
      const CSwarmanoidSpace& space = simulator.GetSpace();
      const Vector3 before = space.GetPose(1).position;
      while (simulator.Step()) continue;
      SCOPED_TRACE(engine + " " + movable);
      if (movable == "false")
      {
        EXPECT_EQ(space.GetPose(1).position, before);
        EXPECT_LT((space.GetPose(1).position - space.GetPose(0).position).x(), 0.5);
        EXPECT_GT((space.GetPose(1).position - space.GetPose(0).position).head<2>().norm(), 0.1 + 0.085 - 1e-3);
      }
      else
      {
        EXPECT_NE(space.GetPose(1).position, before) << "pushed on";
      }
      simulator.Finish();
    }
}

}  // namespace
}  // namespace swarmanoid
