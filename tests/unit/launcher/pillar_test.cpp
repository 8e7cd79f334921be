// Cylinders that do not move stop robots in every engine, and stay where they are.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "simulation/simulator.h"

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
  const std::string path = testing::TempDir() + "pillar_" + std::to_string(getpid()) + ".xml";
  for (const std::string engine : {"kinematics2d", "dynamics2d", "dynamics3d"})
    for (const std::string movable : {"false", "true"})
    {
      std::ofstream(path)
          << "<ahss-config><framework><maxclock>60</maxclock></framework><controllers><pillar_test id='c'><actuators>"
             "<footbot_wheels implementation='dummy_footbot_wheels'/></actuators></pillar_test></controllers>"
             "<arena size='4,4,2' optimization='2D'><footbot id='fb' position='1,2,0' controller='c'/>"
             "<cylindric_prey id='pillar' position='1.5,2,0' radius='0.1' height='0.2' mass='0.2' movable='"
          << movable << "'/></arena><engines><" << engine
          << " id='e'/></engines><arena_physics><engine id='e'><all/></engine></arena_physics></ahss-config>";
      const auto experiment = ReadExperiment(path);
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
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace swarmanoid
