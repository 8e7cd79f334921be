// The control loop with its own clock, and with drivers and a controller that record events.
#include "real_robot/control_loop.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/configuration/xml_reader.h"
#include "footbot/ci_footbot_light_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kMillisecond = 1'000'000;

// The state that the drivers and the controller of a test share.
struct World
{
  std::int64_t now = 0;
  std::vector<std::string> events;
  bool heard = true;
  double silence_s = 0;
  std::vector<double> drawn;  // by the controller: in Init, in each step, in Destroy
  std::function<void(std::uint64_t step)> in_step;
  int destroyed = 0;
};
World* world = nullptr;

class TestLight : public CSensorDriver, public CCI_FootBotLightSensor
{
public:
  void Init(const DriverSetup&) override {}
  CCI_Sensor* Sensor() override { return this; }
  void Poll() override
  {
    world->events.emplace_back("poll");
    readings_[0] = static_cast<double>(world->now);
  }
  std::vector<DriverSource> Sources() const override { return {{"the lamp", world->heard, world->silence_s}}; }
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings_; }

private:
  std::array<double, NUM_SENSORS> readings_{};
};
REGISTER_SENSOR_DRIVER(TestLight, DescribeDriver("footbot_light", "test", "for tests", {"footbot"}))

class TestWheels : public CActuatorDriver, public CCI_FootBotWheelsActuator
{
public:
  void Init(const DriverSetup&) override {}
  CCI_Actuator* Actuator() override { return this; }
  void SetFootBotWheelsAngularVelocity(double left, double) override { left_ = left; }
  void Push() override { world->events.push_back("push " + std::to_string(static_cast<int>(left_))); }
  void Stop() override { world->events.emplace_back("stop"); }

private:
  double left_ = 0;
};
REGISTER_ACTUATOR_DRIVER(TestWheels, DescribeDriver("footbot_wheels", "test", "for tests", {"footbot"}))

class TestController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override
  {
    wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
    Draw();
    return RETURN_OK;
  }
  void ControlStep() override
  {
    world->events.emplace_back("step");
    Draw();
    wheels_->SetFootBotWheelsAngularVelocity(static_cast<double>(GetRobot()->GetTick()), 0);
    if (world->in_step) world->in_step(GetRobot()->GetTick());
  }
  void Destroy() override
  {
    ++world->destroyed;
    Draw();
  }

private:
  void Draw() { world->drawn.push_back(GetRobot()->GetRandom().Uniform()); }

  CCI_FootBotWheelsActuator* wheels_ = nullptr;
};
REGISTER_CONTROLLER(TestController, "control_loop_test")

class ControlLoop : public ::testing::Test
{
protected:
  ControlLoop()
  {
    world = &world_;
    options_.told_to_stop = [] { return false; };
  }
  LoopReport Run(Robot& robot)
  {
    return RunControlLoop(
        robot, options_,
        {[this] { return world_.now; }, [this](std::int64_t until) { world_.now = std::max(world_.now, until); }});
  }
  static RobotConfiguration Configuration()
  {
    RobotConfiguration configuration;
    configuration.id = "r1";
    configuration.kind = "footbot";
    configuration.controller_tag = "control_loop_test";
    configuration.controller_id = "c";
    configuration.sensors = {{"footbot_light", "", {}, {}}};
    configuration.actuators = {{"footbot_wheels", "", {}, {}}};
    return configuration;
  }
  static RobotConfiguration WithTimeout(const std::string& timeout_s)
  {
    RobotConfiguration configuration = Configuration();
    configuration.sensors.front().tree =
        TConfigurationTree(ReadXml("<footbot_light timeout_s=\"" + timeout_s + "\"/>", "robot.xml"));
    return configuration;
  }

  World world_;
  LoopOptions options_;
};

TEST_F(ControlLoop, PollsStepsAndPushesOnceEachPeriodAndStopsAtTheEnd)
{
  Robot robot(Configuration());
  options_.steps = 2;
  const LoopReport report = Run(robot);
  EXPECT_THAT(world_.events, ElementsAre("poll", "poll", "step", "push 0", "poll", "step", "push 1", "stop"));
  EXPECT_EQ(world_.now, 200 * kMillisecond);
  EXPECT_EQ(report.steps, 2U);
  EXPECT_EQ(report.overruns, 0U);
  EXPECT_EQ(world_.destroyed, 1);
}

// The same ones as in the simulator: by seed, id, purpose and step.
TEST_F(ControlLoop, RandomNumbersAreOnesOfTheRobotTheSeedAndTheStep)
{
  RobotConfiguration configuration = Configuration();
  configuration.seed = 9;
  {
    Robot robot(configuration);
    options_.steps = 2;
    Run(robot);
  }
  const std::uint64_t name = StreamName("r1");
  EXPECT_THAT(world_.drawn, ElementsAre(RandomStream(9, name, kInitStream, 0).Uniform(),
                                        RandomStream(9, name, kControlStepStream, 0).Uniform(),
                                        RandomStream(9, name, kControlStepStream, 1).Uniform(),
                                        RandomStream(9, name, kDestroyStream, 2).Uniform()));
}

TEST_F(ControlLoop, LeavesOutStepsThatALongOneMissed)
{
  Robot robot(Configuration());
  std::vector<std::int64_t> starts;
  world_.in_step = [&](std::uint64_t step)
  {
    starts.push_back(world_.now / kMillisecond);
    world_.now += (step == 1 ? 250 : 1) * kMillisecond;
  };
  options_.steps = 4;
  const LoopReport report = Run(robot);
  EXPECT_THAT(starts, ElementsAre(0, 100, 400, 500));
  EXPECT_EQ(report.overruns, 1U);
  EXPECT_DOUBLE_EQ(report.longest_step_s, 0.25);
}

TEST_F(ControlLoop, StandsWhileASensorIsSilentAndGoesOnAfterwards)
{
  Robot robot(Configuration());
  int steps = 0;
  world_.in_step = [&](std::uint64_t) { world_.silence_s = ++steps == 1 ? 1.5 : 0; };
  options_.steps = 2;
  options_.told_to_stop = [this]
  {
    if (world_.events.size() > 8) world_.silence_s = 0;
    return false;
  };
  const LoopReport report = Run(robot);
  EXPECT_THAT(world_.events, ElementsAre("poll", "poll", "step", "push 0", "poll", "stop", "poll", "stop", "poll",
                                         "stop", "poll", "step", "push 1", "stop"));
  EXPECT_NEAR(report.silent_s, 0.3, 1e-12);
}

TEST_F(ControlLoop, ATimeoutOfZeroNeverEndsTheSilenceOfASensor)
{
  Robot robot(WithTimeout("0"));
  world_.silence_s = 1e6;
  options_.end_on_silence = true;
  options_.steps = 2;
  const LoopReport report = Run(robot);
  EXPECT_THAT(world_.events, ElementsAre("poll", "poll", "step", "push 0", "poll", "step", "push 1", "stop"));
  EXPECT_EQ(report.silent_s, 0);
}

TEST_F(ControlLoop, ASensorIsSilentAfterItsTimeoutAndNotAtIt)
{
  Robot robot(WithTimeout("2.5"));
  options_.end_on_silence = true;
  options_.steps = 2;
  world_.silence_s = 2.5;
  EXPECT_EQ(Run(robot).steps, 2U);

  Robot other(WithTimeout("2.5"));
  world_.silence_s = std::nextafter(2.5, 3);
  EXPECT_THROW(Run(other), DriverError);
}

TEST_F(ControlLoop, EndsOnSilenceWhereAsked)
{
  Robot robot(Configuration());
  world_.in_step = [&](std::uint64_t) { world_.silence_s = 1.5; };
  options_.end_on_silence = true;
  EXPECT_EQ(test::MessageOf<DriverError>([&] { Run(robot); }),
            "sensor 'footbot_light': the lamp is silent for 1.5 s; the robot is stopped");
  EXPECT_EQ(world_.events.back(), "stop");
}

TEST_F(ControlLoop, GivesUpWaitingForASensorThatIsNeverHeard)
{
  Robot robot(Configuration());
  world_.heard = false;
  options_.wait_s = 3;
  EXPECT_THAT(test::MessageOf<DriverError>([&] { Run(robot); }),
              HasSubstr("sensor 'footbot_light': nothing heard from the lamp"));
  EXPECT_EQ(world_.now, 3000 * kMillisecond);
}

TEST_F(ControlLoop, StopsTheDevicesOfAControllerThatFails)
{
  {
    Robot robot(Configuration());
    world_.in_step = [](std::uint64_t step)
    {
      if (step == 3) throw std::runtime_error("the floor is wet");
    };
    EXPECT_EQ(test::MessageOf<RobotError>([&] { Run(robot); }), "robot 'r1': ControlStep 3 failed: the floor is wet");
  }
  EXPECT_EQ(world_.events.back(), "stop");
  EXPECT_EQ(world_.destroyed, 1);
}

TEST_F(ControlLoop, NamesTheDriversThereAreForAnUnknownDevice)
{
  RobotConfiguration configuration = Configuration();
  configuration.driver_libraries = {};
  configuration.sensors = {{"footbot_lihgt", "", {}, {}}};
  const std::string mistake = test::MessageOf<ConfigurationError>([&] { Robot robot(configuration); });
  EXPECT_THAT(mistake, HasSubstr("there is no driver for the sensor <footbot_lihgt>"));
  EXPECT_THAT(mistake, HasSubstr("sensors of a footbot with a driver: footbot_light; did you mean 'footbot_light'?"));
}

}  // namespace
}  // namespace swarmanoid
