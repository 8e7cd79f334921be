// The rules of behaviours: sensors are read once, later behaviours override earlier ones, copies are independent.
#include <gmock/gmock.h>

#include "common/control_interface/behavior/ci_behavior_controller.h"
#include "common/control_interface/behavior/ci_footbot_state.h"
#include "tests/world/fake_devices.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using test::FakeProximity;
using test::FakeWheels;

class Drive : public CCI_Behavior<CCI_FootBotState>
{
public:
  Drive(double left, double right) : left_(left), right_(right) {}
  void Step(CCI_FootBotState& state) override { state.SetFootBotWheelsAngularVelocity(left_, right_); }

private:
  double left_;
  double right_;
};

// Backs off, but only when something is near.
class Avoid : public CCI_Behavior<CCI_FootBotState>
{
public:
  void Step(CCI_FootBotState& state) override
  {
    double readings[CCI_FootBotState::NUM_PROXIMITY_SENSORS];
    state.GetAllProximitySensorReadings(readings);
    if (readings[0] > 0.5) state.SetFootBotWheelsAngularVelocity(-1, -1);
  }
};

class Sequential : public CCI_Behavior<CCI_FootBotState>
{
public:
  void Step(CCI_FootBotState& state) override
  {
    drive_.Step(state);
    avoid_.Step(state);
  }

private:
  Drive drive_{2, 3};
  Avoid avoid_;
};

// Two behaviours on copies; the mean of their wishes is taken.
class Parallel : public CCI_Behavior<CCI_FootBotState>
{
public:
  void Step(CCI_FootBotState& state) override
  {
    CCI_FootBotState copy1 = state;
    CCI_FootBotState copy2 = state;
    first_.Step(copy1);
    second_.Step(copy2);
    double left1 = 0;
    double right1 = 0;
    double left2 = 0;
    double right2 = 0;
    copy1.GetFootBotWheelsAngularVelocity(left1, right1);
    copy2.GetFootBotWheelsAngularVelocity(left2, right2);
    EXPECT_FALSE(state.HasNewWheelVelocity());
    state.SetFootBotWheelsAngularVelocity((left1 + left2) / 2, (right1 + right2) / 2);
  }

private:
  Drive first_{2, 0};
  Drive second_{0, 4};
};

template <class Root>
class Controller : public CCI_BehaviorController<CCI_FootBotState>
{
public:
  int Init(const TConfigurationTree) override
  {
    m_pcState = new CCI_FootBotState(GetRobot());
    m_pcState->Init();
    m_pcRootBehavior = new Root();
    m_pcRootBehavior->Init();
    return RETURN_OK;
  }
  void Destroy() override
  {
    m_pcRootBehavior->Destroy();
    delete m_pcState;
    delete m_pcRootBehavior;
  }
};

class BehaviorTest : public testing::Test
{
protected:
  BehaviorTest()
  {
    robot.AddActuator("footbot_wheels", &wheels);
    robot.AddSensor("footbot_proximity", &proximity);
  }
  template <class Root>
  void Run(int steps)
  {
    Controller<Root> controller;
    controller.SetRobot(&robot);
    ASSERT_EQ(controller.Init({}), CCI_Controller::RETURN_OK);
    for (int i = 0; i < steps; ++i) controller.ControlStep();
    controller.Destroy();
  }

  FakeWheels wheels;
  FakeProximity proximity;
  CCI_Robot robot{"fb", "footbot"};
};

TEST_F(BehaviorTest, TheLaterBehaviorOverridesTheEarlierOnlyWhereItDecides)
{
  Run<Sequential>(1);
  EXPECT_THAT(std::pair(wheels.left, wheels.right), testing::Pair(2, 3));
  proximity.readings[0] = 0.9;
  Run<Sequential>(1);
  EXPECT_THAT(std::pair(wheels.left, wheels.right), testing::Pair(-1, -1));
}

TEST_F(BehaviorTest, BehaviorsOnCopiesAreIndependent)
{
  Run<Parallel>(1);
  EXPECT_THAT(std::pair(wheels.left, wheels.right), testing::Pair(1, 2));
}

TEST_F(BehaviorTest, SensorsAreReadOnceAndActuatorsWrittenOnceATick)
{
  Run<Sequential>(5);
  EXPECT_EQ(proximity.reads, 5);
  EXPECT_EQ(wheels.writes, 5);
}

TEST_F(BehaviorTest, ADeviceThatIsNotListedIsNamed)
{
  CCI_FootBotState state(&robot);
  state.Init();
  EXPECT_EQ(
      test::MessageOf<CCI_DeviceError>([&] { state.SetGripper(1); }),
      "robot 'fb' has no actuator 'footbot_gripper'; its controller lists footbot_wheels. Add <footbot_gripper> to "
      "<actuators> of the controller in the experiment file");
}

}  // namespace
}  // namespace swarmanoid
