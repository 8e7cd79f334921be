// Runs with a batch controller have the state hash of the same controller called robot by robot, with noise, random
// numbers, robots that come late, any number of threads and hosts, and from a checkpoint on.
#include <gmock/gmock.h>

#include <fstream>

#include "common/control_interface/ci_batch_controller.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/space/space.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"
#include "test_folders.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

// Returns the speed of the left wheel, by a random number, what is near and where the robot is.
double SpeedOf(RandomStream& random, std::span<const double> proximity, double x)
{
  double speed = 4 * random.Uniform() + x;
  for (std::size_t i = 0; i < proximity.size(); ++i) speed -= static_cast<double>(i % 5) * proximity[i];
  return speed;
}

// Robots that sometimes keep their speeds.
bool Drives(const CCI_Robot& robot) { return (robot.GetTick() + robot.GetId().size()) % 7 != 0; }

class ByBatch : public CCI_BatchController
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlSteps(CCI_Batch& robots) override
  {
    const CCI_Readings proximity = robots.Readings("footbot_proximity");
    const CCI_Readings at = robots.Readings("positioning");
    const CCI_Commands wheels = robots.Commands("footbot_wheels");
    for (std::size_t k = 0; k < robots.Size(); ++k)
    {
      if (!Drives(robots.Robot(k))) continue;
      wheels[k][0] = SpeedOf(robots.Robot(k).GetRandom(), proximity[k], at[k][0]);
      wheels[k][1] = 3;
    }
  }
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }
};
class ByLoop : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    CCI_Robot& robot = *GetRobot();
    if (!Drives(robot)) return;
    const double x = robot.Sensor<CCI_PositioningSensor>("positioning").GetPosition().x();
    const auto proximity = robot.Sensor<CCI_FootBotProximitySensor>("footbot_proximity").GetAllSensorReadings();
    robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels")
        .SetFootBotWheelsAngularVelocity(SpeedOf(robot.GetRandom(), proximity, x), 3);
  }
  bool HasState() const override { return true; }
};
REGISTER_CONTROLLER(ByBatch, "batch_runs_by_batch")
REGISTER_CONTROLLER(ByLoop, "batch_runs_by_loop")

class CAvoider : public CCI_BatchController
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlSteps(CCI_Batch& robots) override;
};
REGISTER_CONTROLLER(CAvoider, "batch_runs_avoider")

// The listing of docs/own_controller.md:
void CAvoider::ControlSteps(CCI_Batch& robots)
{
  const CCI_Readings proximity = robots.Readings("footbot_proximity");
  const CCI_Commands wheels = robots.Commands("footbot_wheels");
  for (std::size_t k = 0; k < robots.Size(); ++k)
  {
    wheels[k][0] = 5;  // rad/s
    wheels[k][1] = proximity[k][0] > 0.1 ? -5 : 5;
  }
}
// Its end.

struct Way
{
  std::string tag = "batch_runs_by_batch";
  std::string attributes{};
  unsigned threads = 1;
  std::string noise{};
};

void AddLate(SpaceEditor& editor)
{
  for (double x = 0.2; x < 3.8; x += 0.1)
    if (const Pose pose{{x, 2, 0}, Quaternion::Identity()}; editor.IsFree("late", pose))
    {
      editor.AddEntity("late", pose);
      return;
    }
  FAIL() << "no place is free";
}

// Forty robots in a small arena, and two more that come at ticks 20 and 40.
std::uint64_t HashOf(const Way& way)
{
  RegisterBuiltins();
  const test::ExperimentText text{
      .framework = "<seed>5</seed><maxclock>150</maxclock>",
      .controllers = test::Controller({.tag = way.tag,
                                       .actuators = {"dummy_footbot_wheels" + way.noise},
                                       .sensors = {"generic_footbot_proximity" + way.noise, "generic_positioning"},
                                       .attributes = way.attributes}),
      .size = "4,4,1",
      .arena =
          "<distribute quantity='40'><position method='uniform'/><orientation method='uniform'/>"
          "<footbot id='r' controller='c'/></distribute>"
          "<reserve quantity='2'><footbot id='late' controller='c'/></reserve>"};
  const std::unique_ptr<Experiment> experiment = text.Load();
  SimulatorOptions options;
  options.threads = way.threads;
  CSimulator simulator(*experiment, options);
  do {
    const std::uint64_t tick = simulator.GetSpace().GetTick();
    if (tick == 20 || tick == 40) AddLate(simulator.GetEditor());
  } while (simulator.Step());
  return simulator.Finish().hash;
}

std::string TextOf(const std::string& file)
{
  std::ifstream stream(SWARMANOID_SOURCE_FOLDER + file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(BatchRuns, TheListingOfTheDocumentationCompilesAndDrives)
{
  std::string own = TextOf("/tests/unit/device_runs/batch_runs_test.cpp");
  own = own.substr(own.find("void CAvoider::"));
  own = own.substr(0, own.find("// Its end."));
  EXPECT_THAT(TextOf("/docs/own_controller.md"), testing::HasSubstr("```cpp\n" + own + "```\n"));
  EXPECT_NE(HashOf({.tag = "batch_runs_avoider"}), HashOf({.tag = "batch_runs_by_loop"}));
}

TEST(BatchRuns, HaveTheHashOfTheLoop)
{
  for (const std::string noise : {"", " noise_kind='gaussian' noise_deviation='0.05'"})
  {
    const std::uint64_t loop = HashOf({.tag = "batch_runs_by_loop", .noise = noise});
    EXPECT_EQ(HashOf({.noise = noise}), loop);
    EXPECT_EQ(HashOf({.threads = 2, .noise = noise}), loop);
    EXPECT_EQ(HashOf({.threads = 3, .noise = noise}), loop);
    EXPECT_EQ(HashOf({.attributes = "on_failure='stop_robot'", .noise = noise}), loop);
  }
}

}  // namespace
}  // namespace swarmanoid
